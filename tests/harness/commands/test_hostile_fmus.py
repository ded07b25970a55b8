"""An FMU that forks, exits, crashes, hangs, prints, eats memory or kills ends with its command.

One FMU does what the environment variable FAULT names, which also tells its processes from others.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest

from tests.harness import faulty_fmus

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="reads /proc; adopts orphans")

FAULTS: Mapping[str, tuple[int, str]] = {
    "fork": (1, ""),
    "fork_session": (1, ""),
    "fork_twice": (1, ""),
    "fork_many": (2, "processes; must be at most 250"),
    "fork_and_exit": (2, "its process ended with exit code 0"),
    "exit": (2, "its process ended with exit code 0"),
    "crash": (2, "crashed in fmi2DoStep: its process ended with SIGABRT"),
    "sleep": (2, "no answer within the time limit of"),
    "stop": (2, "no answer within the time limit of"),
    "spam": (2, "no answer within the time limit of"),
    "spam_log": (2, "no answer within the time limit of"),
    "eat": (2, "MiB in memory; must be at most 400 MiB"),
    "kill_group": (2, "its process ended with SIGKILL"),
    "kill_parent": (2, "has ended the process that watches it"),
    "fork_and_kill_parent": (2, "has ended the process that watches it"),
}
"""What the FMU does in fmi2DoStep, with the exit code of `validate` and the reason."""
QUICK = ("fork_twice", "fork_and_kill_parent")


@pytest.fixture(scope="module")
def hostile_fmu(native_fmu: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("hostile")
    return faulty_fmus.compiled(native_fmu, folder / "hostile.fmu", "IN_STEP=FAULT", "VALUE=1.0")


def processes_of(mark: str) -> list[str]:
    """The processes that have inherited FAULT with this value."""
    found = []
    for environment in Path("/proc").glob("[0-9]*/environ"):
        try:
            if f"FAULT={mark}".encode() in environment.read_bytes().split(b"\0"):
                found.append(environment.parent.name)
        except OSError:
            continue
    return found


class Ran:
    """A command with a fault: how it ended, and what it has left."""

    def __init__(self, fault: str, folder: Path, *arguments: object) -> None:
        mark = f"{fault}:{folder}"
        temporary, here = folder / "temporary", folder / "here"
        temporary.mkdir()
        here.mkdir()
        self.done = subprocess.run(
            [sys.executable, "-m", "slider_resonator", *map(str, arguments)],
            env={**os.environ, "FAULT": mark, "TMPDIR": str(temporary)},
            cwd=here,
            capture_output=True,
            text=True,
            timeout=120.0,
            check=False,
        )
        assert not processes_of(mark), "no process is left"
        assert not list(temporary.iterdir()), "no folder is left"
        self.left = list(here.iterdir())


@pytest.mark.parametrize(
    "fault",
    [pytest.param(name, marks=() if name in QUICK else pytest.mark.slow) for name in FAULTS],
)
def test_validate_outlives_an_fmu(hostile_fmu: Path, tmp_path: Path, fault: str) -> None:
    names = ("a", "b", "c", "d")
    scenes = [argument for n in names for argument in ("--scene", faulty_fmus.scene(tmp_path, n))]
    reports = [tmp_path / f"report.{kind}" for kind in ("json", "xml", "html")]
    options = [word for r in reports for word in (f"--{r.suffix[1:]}".replace("xml", "junit"), r)]
    ran = Ran(
        fault,
        tmp_path,
        *("--max-memory", 400, "validate", hostile_fmu, "--time-limit", 2, *scenes, *options),
    )
    code, reason = FAULTS[fault]
    assert ran.done.returncode == code, ran.done.stderr
    assert reason in ran.done.stderr
    assert not ran.left, "the FMU does not run in the user's folder"
    validation = json.loads(reports[0].read_text())
    assert bool(validation["errors"]) == (code == 2)
    (suite,) = ET.parse(reports[1]).getroot()
    assert (suite.get("errors") != "0") == (code == 2)
    assert reports[2].read_text().rstrip().endswith("</html>")
    for report in reports:
        assert "\x1b" not in report.read_text()


@pytest.fixture
def commands(tmp_path: Path, hostile_fmu: Path) -> Mapping[str, list[object]]:
    """Commands that step the FMU, and what else they are given."""
    grid, scene = tmp_path / "grid.toml", tmp_path / "need.toml"
    grid.write_text(
        'measures = ["velocity.rms"]\n[grid]\nphase = [0.0]\n[run]\ndrive_periods = 2\n'
    )
    need = "[need]\nmean_velocity = { rel = 0.05 }\n"
    scene.write_text(faulty_fmus.scene(tmp_path).read_text() + need)
    limit = ("--time-limit", 5)
    out = tmp_path / "out"
    return {
        "run": ["run", hostile_fmu, scene, *limit],
        "run --auto": ["run", hostile_fmu, scene, "--auto", *limit],
        "steady": ["steady", hostile_fmu, *limit],
        "blocking": ["blocking", hostile_fmu, *limit],
        "choose": ["choose", scene, "--fmu", hostile_fmu, *limit],
        "sweep": ["sweep", grid, "--fmu", hostile_fmu, "--out", tmp_path / "t.csv", *limit],
        "trade": ["trade", scene, "--fmu", hostile_fmu, "--out", out, "--periods", 4, *limit],
        "paper": ["paper", "--fmu", hostile_fmu, "--out", out, "--only", "figure_2", *limit],
        "bench": ["bench", hostile_fmu, "--repeats", 1, *limit],
        "hosts": ["hosts", hostile_fmu, "--python-fmu", hostile_fmu, "--host", "fmpy", *limit],
        "baseline": ["baseline", "record", hostile_fmu, "--dir", out, "--scene", scene, *limit],
    }


COMMANDS = (
    *("run", "run --auto", "steady", "blocking", "choose", "sweep", "trade", "paper", "bench"),
    *("hosts", "baseline"),
)


@pytest.mark.slow
@pytest.mark.parametrize("fault", ["exit", "fork_and_kill_parent"])
@pytest.mark.parametrize("command", COMMANDS)
def test_every_command_outlives_an_fmu(
    commands: Mapping[str, list[object]], tmp_path: Path, command: str, fault: str
) -> None:
    ran = Ran(fault, tmp_path, *commands[command])
    # A point of a sweep that fails is a row with its error.
    assert ran.done.returncode == (1 if command == "sweep" else 2), ran.done.stderr
    assert "Traceback" not in ran.done.stderr
    assert ran.done.stderr or command == "sweep"
    assert not ran.left
