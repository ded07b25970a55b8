"""The layers of the C sources: they hold, and an include against them is found."""

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from fmu_src.sources import C_SOURCES, CONTROLLER_SOURCES
from tests.processes import ROOT, run_command


def check(root: Path) -> subprocess.CompletedProcess[str]:
    """Check the layers as `make lint` does."""
    return run_command(sys.executable, "-m", "fmu_src.c_layers", root, cwd=ROOT)


@pytest.fixture
def copy(tmp_path: Path) -> Path:
    """A copy of the sources that the layers are about."""
    return shutil.copytree(C_SOURCES, tmp_path / "c")


@pytest.mark.parametrize("root", [C_SOURCES, CONTROLLER_SOURCES], ids=["slider", "controller"])
def test_sources_keep_their_layers(root: Path) -> None:
    result = check(root)
    assert result.returncode == 0, result.stdout


@pytest.mark.parametrize(
    ("including", "line", "broken"),
    [
        (
            "device/plant.h",
            '#include "../leap/leap.h"',
            "device/plant.h includes leap/leap.h, which is above it",
        ),
        (
            "base/refusal.c",
            '#include "../component/variables.h"',
            "base/refusal.c includes component/variables.h, which is above it",
        ),
        (
            "friction/bristle.h",
            '#include "system.h"',
            "friction/bristle includes friction/system includes friction/bristle: a circle",
        ),
        (
            "friction/system.c",
            '#include "bending_panel.h"',
            "friction/bending_panel includes friction/system includes friction/bending_panel",
        ),
        (
            "device/plant.c",
            '#include "../../controller/c/component/control.h"',
            "which is in no layer",
        ),
    ],
)
def test_planted_include_is_found(copy: Path, including: str, line: str, broken: str) -> None:
    path = copy / including
    path.write_text(f"{line}\n{path.read_text(encoding='utf-8')}", encoding="utf-8")
    result = check(copy)
    assert result.returncode == 1, result.stdout
    assert broken in result.stdout


@pytest.mark.parametrize(
    ("name", "broken"),
    [
        ("stray.h", "stray.h: must be in one of the folders base, device, "),
        ("tools/stray.h", "tools/stray.h: must be in one of the folders base, device, "),
        ("leap/plant.c", "leap/plant.c: device/plant.c has the same name; must be unique"),
    ],
)
def test_misplaced_file_is_found(copy: Path, name: str, broken: str) -> None:
    path = copy / name
    path.parent.mkdir(exist_ok=True)
    path.touch()
    result = check(copy)
    assert result.returncode == 1, result.stdout
    assert broken in result.stdout
