"""The wheel: what it brings, and that it works where the user has folders of the same names."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

from tests.processes import ROOT, run_command


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The wheel, built from a copy, for setuptools leaves files beside the sources."""
    folder = tmp_path_factory.mktemp("wheel")
    source = folder / "source"
    shutil.copytree(ROOT / "harness", source / "harness")
    for name in ("pyproject.toml", "README.md", "LICENSE"):
        shutil.copy(ROOT / name, source)
    command = [sys.executable, "-m", "pip", "wheel", "-qq", "--no-deps", "--no-build-isolation"]
    subprocess.run([*command, "--wheel-dir", str(folder), str(source)], check=True)
    (built,) = folder.glob("*.whl")
    return built


@pytest.fixture(scope="module")
def installed(wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with what the wheel installs."""
    folder = tmp_path_factory.mktemp("installed")
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(folder)
    return folder


def test_wheel_installs_one_package(installed: Path) -> None:
    names = {path.name for path in installed.iterdir() if path.suffix != ".dist-info"}
    assert names == {"slider_resonator"}


@pytest.mark.parametrize("pattern", ["*.py", "*.toml", "*.c", "*.h", "py.typed"])
def test_wheel_has_every_file_of_the_package(installed: Path, pattern: str) -> None:
    source = ROOT / "harness" / "slider_resonator"
    expected = {path.relative_to(source) for path in source.rglob(pattern)}
    package = installed / "slider_resonator"
    assert expected
    assert {path.relative_to(package) for path in package.rglob(pattern)} == expected


def test_folder_with_a_harness_of_its_own(
    installed: Path, native_fmu: Path, tmp_path: Path
) -> None:
    """PYTHONPATH=. puts the user's own modules first: none of them is taken for ours."""
    for name in ("harness", "scenes", "fmu", "device"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "__init__.py").write_text("raise RuntimeError('not ours')\n")
    path = os.pathsep.join([".", str(installed)])
    result = run_command(
        *(sys.executable, "-m", "slider_resonator", "validate", native_fmu),
        *("--scene", "blocking_force_table_1"),
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": path},
    )
    assert result.returncode == 0, result.stdout + result.stderr
    assert "passed" in result.stdout
