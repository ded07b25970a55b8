"""Code of the documentation prints what it says."""

import os
import re
import shutil
import sys
from pathlib import Path

import pytest

from slider_resonator.sweeping.grid import read_grid
from slider_resonator.sweeping.picture import check_picture
from tests.processes import ROOT, run_command

DOCS = ROOT / "docs"


def printed(code: str, file: Path, folder: Path) -> list[str]:
    """The lines that code prints in a folder whose folder `dist` has a file."""
    (folder / "dist").mkdir()
    shutil.copy(file, folder / "dist")
    own = {"PYTHONPATH": str(ROOT / "harness"), "LD_LIBRARY_PATH": f"{sys.prefix}/lib"}  # of tbb
    done = run_command(sys.executable, "-c", code, cwd=folder, env={**os.environ, **own})
    assert done.returncode == 0, done.stderr
    return done.stdout.splitlines()


def documented(code: str) -> str:
    """What code prints by its only comment."""
    (output,) = re.findall(r"^ *# (.*)$", code, re.MULTILINE)
    return str(output)


(API_EXAMPLE,) = re.findall(r"```python\n(.*?)```", (DOCS / "api.md").read_text("utf-8"), re.DOTALL)


def test_the_example_of_the_page_runs(
    native_fmu: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("slider_resonator.fmu.finished.FOLDERS", (native_fmu.parent,))
    exec(compile(API_EXAMPLE, "docs/api.md", "exec"), {})
    assert (tmp_path / "start.png").is_file()
    assert (tmp_path / "curve.csv").read_text().count("\n") == 74
    assert "points     73" in capsys.readouterr().out


CODE = re.findall(r"```python\n(.*?)```", (DOCS / "closed_loop.md").read_text("utf-8"), re.DOTALL)
FMPY, VARIED, OWN, LIBCOSIMPY, ECOS = CODE


@pytest.mark.parametrize(
    "code",
    [
        pytest.param(FMPY, id="fmpy"),
        pytest.param(VARIED, id="inputs-that-vary"),
        pytest.param(LIBCOSIMPY, id="libcosimpy", marks=pytest.mark.interop),
        pytest.param(ECOS, id="ecos", marks=pytest.mark.interop),
    ],
)
def test_documented_code_prints_the_documented_output(
    code: str, closed_loop_package: Path, tmp_path: Path
) -> None:
    assert printed(code, closed_loop_package, tmp_path)[-1] == documented(code)


def test_the_loop_of_another_device_holds_half_its_velocity(
    closed_loop_package: Path, native_fmu: Path, tmp_path: Path
) -> None:
    code = OWN.replace("open_fmu(", f"open_fmu({str(native_fmu)!r}, ")
    code = code.replace("sr.fmu_path()", f"Path({str(closed_loop_package)!r})")
    code = f"from pathlib import Path\n{code}"
    assert printed(code, closed_loop_package, tmp_path)[-1] == documented(code)


TEXT = (ROOT / "README.md").read_text(encoding="utf-8")


def script(number: int) -> str:
    return str(re.findall(r"^```python\n(.*?)^```", TEXT, re.MULTILINE | re.DOTALL)[number])


def test_the_first_script_prints_what_it_says(native_fmu: Path, tmp_path: Path) -> None:
    code = script(0)
    said = re.findall(r"^print\(.*\)  # (.*)$", code, re.MULTILINE)
    assert len(said) == 2
    for line, end in zip(printed(code, native_fmu, tmp_path), said, strict=True):
        assert line.endswith(f" {end}")


def test_the_script_of_the_api_is_ten_lines_that_run(native_fmu: Path, tmp_path: Path) -> None:
    code = script(1).replace("sr.open_fmu()", f"sr.open_fmu({str(native_fmu)!r})")
    code = code.replace("sr.fmu_path()", repr(str(native_fmu)))
    assert len(code.splitlines()) <= 10
    _, run, steady = printed(code, native_fmu, tmp_path)
    assert run == "0.094666 m/s after 4 s"
    assert steady == "0.0986951 m/s in steady motion"


def test_the_map_has_40_000_points_that_all_repeat() -> None:
    sweep = read_grid(DOCS / "steady_velocity.toml")
    check_picture(sweep, "--plot")
    assert len(sweep.points) == 40_000
    ratios = {ratio for ratio, _ in sweep.points}
    assert all(abs(20.0 * ratio - round(20.0 * ratio)) < 1e-9 for ratio in ratios)


def test_the_grids_of_the_page_are_read(tmp_path: Path) -> None:
    page = (DOCS / "sweeps.md").read_text(encoding="utf-8")
    counts = []
    for text in re.findall(r"```toml\n(.*?)```", page, re.DOTALL):
        (tmp_path / "grid.toml").write_text(text, encoding="utf-8")
        counts.append(len(read_grid(tmp_path / "grid.toml").points))
    assert counts == [63 * 3 * 10, 3 * 41]
