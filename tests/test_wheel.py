"""The wheel: what it brings, and that it works where the user has folders of the same names."""

import os
import re
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

from fmu_src.building import wheel_backend
from tests.processes import ROOT, run_command


@pytest.fixture(scope="module")
def wheel(native_fmu: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The wheel with a finished FMU, built from a copy: setuptools leaves files beside sources."""
    folder = tmp_path_factory.mktemp("wheel")
    source = folder / "source"
    for name in ("harness", "fmu_src"):
        ignored = shutil.ignore_patterns("__pycache__", "finished")
        shutil.copytree(ROOT / name, source / name, ignore=ignored)
    for name in ("pyproject.toml", "README.md", "LICENSE", "MANIFEST.in", "build_fmu.py"):
        shutil.copy(ROOT / name, source)
    # As pip calls it, without what pip does besides.
    call = "wheel_backend.build_wheel(sys.argv[1], {'fmus': sys.argv[2]})"
    code = f"import sys; from fmu_src.building import wheel_backend; {call}"
    command = [sys.executable, "-c", code, str(folder), str(native_fmu.parent)]
    subprocess.run(command, cwd=source, check=True, capture_output=True)
    (built,) = folder.glob("*.whl")
    return built


@pytest.fixture(scope="module")
def installed(wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with what the wheel installs."""
    folder = tmp_path_factory.mktemp("installed")
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(folder)
    return folder


def printed(folder: Path, path: list[object], *arguments: object) -> str:
    """What Python prints in a folder, with other folders on its path, without an error."""
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(map(str, path))}
    done = run_command(sys.executable, *arguments, cwd=folder, env=environment)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def test_wheel_installs_one_package_with_all_its_files(wheel: Path, installed: Path) -> None:
    names = {path.name for path in installed.iterdir() if path.suffix != ".dist-info"}
    assert names == {"slider_resonator"}
    source, package = ROOT / "harness" / "slider_resonator", installed / "slider_resonator"
    for pattern in ("*.py", "*.toml", "*.js", "*.css", "py.typed"):
        expected = {path.relative_to(source) for path in source.rglob(pattern)}
        assert expected
        assert {path.relative_to(package) for path in package.rglob(pattern)} == expected
    built_from = wheel.parent / "source" / "harness" / "slider_resonator"
    assert not (built_from / "finished").exists(), "nothing of the build stays in the sources"


@pytest.mark.slow
def test_folder_with_a_harness_of_its_own(
    installed: Path, native_fmu: Path, tmp_path: Path
) -> None:
    """PYTHONPATH=. puts the user's own modules first: none of them is taken for ours."""
    for name in ("harness", "scenes", "fmu", "device"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "__init__.py").write_text("raise RuntimeError('not ours')\n")
    arguments = ("validate", native_fmu, "--scene", "blocking_force_table_1")
    assert "passed" in printed(tmp_path, [".", installed], "-m", "slider_resonator", *arguments)


def test_wheel_brings_the_finished_fmu_and_no_build_tool(
    installed: Path, native_fmu: Path, tmp_path: Path
) -> None:
    script = "import slider_resonator as sr\nwith sr.open_fmu() as fmu: print(fmu.path)"
    path = Path(printed(tmp_path, [installed], "-c", script).strip())
    assert path.is_relative_to(installed)
    assert path.read_bytes() == native_fmu.read_bytes()
    (metadata,) = installed.glob("*.dist-info/METADATA")
    asked = re.findall(r"^Requires-Dist: (?!.*extra ==)(.*)$", metadata.read_text("utf-8"), re.M)
    assert asked
    assert not [name for name in asked if name.startswith(("ziglang", "pythonfmu"))]


def test_a_folder_without_fmus_makes_no_wheel(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError, match="no FMU in this folder"):
        wheel_backend.build_wheel(str(tmp_path), {"fmus": str(tmp_path)})
    assert list(tmp_path.iterdir()) == []


def test_a_wheel_needs_what_builds_fmus_unless_they_are_given() -> None:
    assert any(name.startswith("ziglang") for name in wheel_backend.get_requires_for_build_wheel())
    assert wheel_backend.get_requires_for_build_wheel({"fmus": "dist"}) == []
