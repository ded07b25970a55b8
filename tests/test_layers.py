"""The layers that pyproject.toml describes: they hold, and an import against them is found."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.processes import ROOT, run_command

HARNESS = Path("harness")
HOST_LIBRARIES = {"cofmupy", "ecospy", "fmpy", "fmuloader", "libcosimpy", "pathsim", "pathsim_fmi"}
"""What a host module may need beside the standard library: the simulator that it drives."""


@pytest.fixture
def copy(tmp_path: Path) -> Path:
    """A copy of the sources that the layers are about."""
    shutil.copy(ROOT / "pyproject.toml", tmp_path)
    for folder in (HARNESS, Path("fmu_src")):
        ignored = shutil.ignore_patterns("__pycache__")
        shutil.copytree(ROOT / folder, tmp_path / folder, ignore=ignored)
    return tmp_path


def lint(folder: Path) -> subprocess.CompletedProcess[str]:
    """Check the layers as `make lint` does."""
    command = (Path(sys.executable).with_name("lint-imports"), "--no-cache")
    return run_command(*command, cwd=folder, env={**os.environ, "PYTHONPATH": "harness"})


def test_sources_keep_their_layers(copy: Path) -> None:
    result = lint(copy)
    assert result.returncode == 0, result.stdout


@pytest.mark.parametrize(
    ("importing", "line", "broken"),
    [
        pytest.param(
            "slider_resonator/device/interface.py",
            "import slider_resonator.commands.options",
            "slider_resonator.device is not allowed to import slider_resonator.commands",
            id="upwards",
        ),
        pytest.param(
            "slider_resonator/errors.py",
            "import slider_resonator.cli",
            "slider_resonator.errors is not allowed to import slider_resonator.cli",
            id="from the ground to the roof",
        ),
        pytest.param(
            "slider_resonator/choosing/probe.py",
            "import slider_resonator.sweeping.grid",
            "slider_resonator.choosing is not allowed to import",
            id="between rooms of a layer",
        ),
        pytest.param(
            "slider_resonator/sweeping/grid.py",
            "import studies.paper.claim",
            "slider_resonator is not allowed to import studies",
            id="from what is installed to a study",
        ),
        pytest.param(
            "slider_resonator/references/closed_forms.py",
            "import fmu_src.python.slider_component.prediction",
            "slider_resonator is not allowed to import fmu_src",
            id="from a reference to the component",
        ),
        pytest.param(
            "slider_resonator/references/resolved/trajectory.py",
            "import slider_resonator.references.resolved.taylor",
            "No cycles are allowed in slider_resonator.references.resolved",
            id="in a circle",
        ),
        pytest.param(
            "studies/hosts/job.py",
            "import numpy",
            "studies.hosts.job is not allowed to import numpy",
            id="numpy into a host",
        ),
    ],
)
def test_planted_import_is_found(copy: Path, importing: str, line: str, broken: str) -> None:
    path = copy / HARNESS / importing
    path.write_text(path.read_text(encoding="utf-8") + f"\n{line}\n", encoding="utf-8")
    result = lint(copy)
    assert result.returncode == 1, result.stdout
    assert broken in " ".join(result.stdout.split())


@pytest.mark.parametrize(
    "module", sorted(p.stem for p in (ROOT / "harness" / "studies" / "hosts").glob("*_host.py"))
)
def test_host_module_needs_only_its_host(module: str) -> None:
    """A foreign environment has the simulator and the standard library, but not our packages."""
    name = f"studies.hosts.{module}"
    code = f"import sys; sys.path.insert(0, sys.argv[1]); import {name}"
    result = run_command(sys.executable, "-I", "-S", "-c", code, ROOT / "harness")
    missing = result.stderr.strip().rpartition("No module named ")[2].strip("'").partition(".")[0]
    assert result.returncode == 0 or missing in HOST_LIBRARIES, result.stderr
