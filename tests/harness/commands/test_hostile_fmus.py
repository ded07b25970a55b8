"""An FMU that forks, exits, crashes, hangs, prints, eats memory or kills ends with its command.

One FMU does what the environment variable FAULT names, which also tells its processes from others.
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest

from slider_resonator.fmu.limits import DEFAULTS, MEMORY
from tests.harness import faulty_fmus
from tests.harness.calling import call

pytestmark = [
    pytest.mark.isolated,
    pytest.mark.skipif(sys.platform != "linux", reason="reads /proc; adopts orphans"),
]

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
"""Run as processes of their own, and by default."""
ENDED_SOON = ("fork_many", "eat")
"""Ended once they have too much, which takes some seconds on a busy machine."""


@pytest.fixture(scope="module")
def hostile_fmu(native_fmu: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("hostile")
    return faulty_fmus.compiled(native_fmu, folder / "hostile.fmu", "IN_STEP=FAULT", "VALUE=1.0")


def processes_of(mark: str) -> list[str]:
    """The processes that have inherited FAULT with this value; this one was started without."""
    found = []
    for environment in Path("/proc").glob("[0-9]*/environ"):
        try:
            if f"FAULT={mark}".encode() in environment.read_bytes().split(b"\0"):
                found.append(environment.parent.name)
        except OSError:
            continue
    return found


@dataclass(frozen=True)
class Ended:
    """How a command ended: exit code, standard error and what it left in its folder."""

    code: int
    errors: str
    left: list[Path]


class Runner:
    """Runs commands with a fault in `folder`, in this process unless `apart`.

    A process of its own takes most of its time to load; this one sees all that a command leaves.
    """

    def __init__(self, folder: Path, patch: pytest.MonkeyPatch) -> None:
        self._folder = folder
        self._patch = patch

    def run(self, fault: str, *arguments: object, apart: bool = False) -> Ended:
        mark = f"{fault}:{self._folder}"
        temporary, here = self._folder / "temporary", self._folder / "here"
        temporary.mkdir()
        here.mkdir()
        self._patch.setenv("FAULT", mark)
        self._patch.setenv("TMPDIR", str(temporary))
        self._patch.setenv(MEMORY, str(DEFAULTS[MEMORY]))  # an option sets it for good
        self._patch.setattr(tempfile, "tempdir", None)
        self._patch.chdir(here)
        code, errors = (_apart if apart else _here)(arguments)
        assert not processes_of(mark), "no process is left"
        assert not list(temporary.iterdir()), "no folder is left"
        return Ended(code, errors, list(here.iterdir()))


def _apart(arguments: Sequence[object]) -> tuple[int, str]:
    command = [sys.executable, "-m", "slider_resonator", *map(str, arguments)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120.0, check=False)
    return done.returncode, done.stderr


def _here(arguments: Sequence[object]) -> tuple[int, str]:
    done = call(*arguments)
    return done.exit_code, done.stderr


@pytest.fixture
def runner(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Runner:
    return Runner(tmp_path, monkeypatch)


@pytest.mark.parametrize(
    "fault",
    [pytest.param(name, marks=() if name in QUICK else pytest.mark.slow) for name in FAULTS],
)
def test_validate_outlives_an_fmu(
    hostile_fmu: Path, tmp_path: Path, runner: Runner, fault: str
) -> None:
    names = ("a", "b")
    scenes = [argument for n in names for argument in ("--scene", faulty_fmus.scene(tmp_path, n))]
    reports = [tmp_path / f"report.{kind}" for kind in ("json", "xml", "html")]
    options = [word for r in reports for word in (f"--{r.suffix[1:]}".replace("xml", "junit"), r)]
    limit = 30 if fault in ENDED_SOON else 2
    validate = ("--max-memory", 400, "validate", hostile_fmu, "--time-limit", limit)
    ran = runner.run(fault, *validate, *scenes, *options, apart=fault in QUICK)
    code, reason = FAULTS[fault]
    assert ran.code == code, ran.errors
    assert reason in ran.errors
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
    commands: Mapping[str, list[object]], runner: Runner, command: str, fault: str
) -> None:
    apart = command == "bench"  # which keeps what it has compiled to the end of its process
    ran = runner.run(fault, *commands[command], apart=apart)
    # A point of a sweep that fails is a row with its error.
    assert ran.code == (1 if command == "sweep" else 2), ran.errors
    assert "Traceback" not in ran.errors
    assert ran.errors or command == "sweep"
    assert not ran.left
