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


def blocks_of(page: str, language: str = "python") -> list[str]:
    """The blocks of code on a page."""
    text = (ROOT / page).read_text(encoding="utf-8")
    return re.findall(rf"^```{language}\n(.*?)^```", text, re.MULTILINE | re.DOTALL)


def documented(code: str) -> list[str]:
    """What code prints by its comments at the ends of lines or, if there are none, alone in one."""
    after_code = re.findall(r"^print\(.*\)  # (.*)$", code, re.MULTILINE)
    return after_code or re.findall(r"^ *# (.*)$", code, re.MULTILINE)


@pytest.fixture(autouse=True)
def working_folder(
    closed_loop_package: Path, native_fmu: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A folder whose folder `dist` has the native FMU and the closed loop."""
    (tmp_path / "dist").mkdir()
    for file in (closed_loop_package, native_fmu):
        shutil.copy(file, tmp_path / "dist")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("slider_resonator.fmu.finished.FOLDERS", (tmp_path / "dist",))


def printed(code: str, capsys: pytest.CaptureFixture[str]) -> list[str]:
    """The lines that code prints."""
    exec(compile(code, "documentation", "exec"), {})
    return capsys.readouterr().out.splitlines()


def test_the_example_of_the_api_runs(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (code,) = blocks_of("docs/api.md")
    assert "points     73" in "\n".join(printed(code, capsys))
    assert (tmp_path / "start.png").is_file()
    assert (tmp_path / "curve.csv").read_text().count("\n") == 74


FMPY, VARIED, OWN, LIBCOSIMPY, ECOS = blocks_of("docs/closed_loop.md")
FIRST, API = blocks_of("README.md")


@pytest.mark.parametrize(
    "code", [FMPY, VARIED, OWN, FIRST], ids=["fmpy", "inputs that vary", "own device", "README"]
)
def test_documented_code_prints_the_documented_output(
    code: str, capsys: pytest.CaptureFixture[str]
) -> None:
    said = documented(code)
    lines = printed(code, capsys)
    assert said
    for line, end in zip(lines[-len(said) :], said, strict=True):
        assert line == end or line.endswith(f" {end}")


def test_the_script_of_the_api_is_ten_lines_that_run(capsys: pytest.CaptureFixture[str]) -> None:
    assert len(API.splitlines()) <= 10
    _, run, steady = printed(API, capsys)
    assert run == "0.094666 m/s after 4 s"
    assert steady == "0.0986951 m/s in steady motion"


@pytest.mark.interop
@pytest.mark.parametrize(
    "code",
    [
        pytest.param(LIBCOSIMPY, id="libcosimpy, closed loop"),
        pytest.param(ECOS, id="ecos, closed loop"),
        *(pytest.param(*blocks_of(f"docs/recipes/{n}.md"), id=n) for n in ("ecos", "libcosim")),
    ],
)
def test_documented_code_of_other_hosts_prints_the_documented_output(code: str) -> None:
    done = run_command(
        *(sys.executable, "-c", code),
        env=os.environ | {"LD_LIBRARY_PATH": f"{sys.prefix}/lib"},  # of tbb
    )
    assert done.returncode == 0, done.stderr
    (said,) = documented(code)
    assert said in done.stdout.splitlines()


def test_the_grids_of_the_documentation_are_read(tmp_path: Path) -> None:
    """That of the map has points that all repeat."""
    sweep = read_grid(ROOT / "docs" / "steady_velocity.toml")
    check_picture(sweep, "--plot")
    assert len(sweep.points) == 40_000
    assert all(abs(20.0 * ratio - round(20.0 * ratio)) < 1e-9 for ratio, _ in sweep.points)
    counts = []
    for text in blocks_of("docs/sweeps.md", "toml"):
        (tmp_path / "grid.toml").write_text(text, encoding="utf-8")
        counts.append(len(read_grid(tmp_path / "grid.toml").points))
    assert counts == [63 * 3 * 10, 3 * 41]
