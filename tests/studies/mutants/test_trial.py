from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from slider_resonator.output.progress import no_progress
from slider_resonator.scenes.scene import scene_from
from studies.mutants.archive import PythonFmu, read_python_fmu
from studies.mutants.points import probe_points, scene_points
from studies.mutants.trial import ExpectedPoint, Rejection, trial
from tests.harness import faulty_fmus

Faulty = Callable[[str, str, str], Path]


@pytest.fixture(scope="module")
def points(tmp_path_factory: pytest.TempPathFactory) -> list[ExpectedPoint]:
    scene = faulty_fmus.scene(tmp_path_factory.mktemp("scene"))
    return scene_points([scene], no_progress)


@pytest.fixture
def faulty(python_fmu: Path, tmp_path: Path) -> Faulty:
    fmu: PythonFmu = read_python_fmu(python_fmu)

    def make(file: str, old: str, new: str) -> Path:
        assert old in fmu.modules[file]
        out = tmp_path / "faulty.fmu"
        fmu.write(out, {fmu.path_of(file): fmu.modules[file].replace(old, new, 1)})
        return out

    return make


def test_the_original_passes(python_fmu: Path, points: list[ExpectedPoint]) -> None:
    assert trial(python_fmu, points, 60.0) is None


def test_a_failed_check_rejects(faulty: Faulty, points: list[ExpectedPoint]) -> None:
    fmu = faulty("device.py", "drive = force", "drive = 1.01 * force")
    outcome = trial(fmu, points, 60.0)
    assert isinstance(outcome, Rejection)
    assert (outcome.scene, outcome.quantity) == ("short", "position")
    assert "off by" in outcome.reason


@pytest.mark.parametrize(
    ("new", "reason"),
    [
        ("while True: pass", "no answer within the time limit"),
        ("import ctypes; ctypes.string_at(0)", "crashed in fmi2DoStep"),
        ("raise RuntimeError('broken')", "broken"),
    ],
)
def test_a_hang_a_crash_and_an_error_reject(
    faulty: Faulty, points: list[ExpectedPoint], new: str, reason: str
) -> None:
    first = "    turn = tau / LONGEST_ARC * arc\n"
    outcome = trial(faulty("events.py", first, f"{first}    {new}\n"), points, 3.0)
    assert isinstance(outcome, Rejection)
    assert reason in outcome.reason
    assert not outcome.quantity


def test_a_value_that_is_no_number_rejects(faulty: Faulty, points: list[ExpectedPoint]) -> None:
    """pythonfmu then leaves a Python exception set, and fmi2GetReal reports nothing."""
    values = "return self._component.get(*(v.name for v in _variables("
    outcome = trial(
        faulty("slave.py", f'{values}"Real", vrs)))', "return [None] * len(vrs)"), points, 60.0
    )
    assert isinstance(outcome, Rejection)
    assert "left a Python exception behind: TypeError" in outcome.reason
    assert not outcome.quantity


def test_an_fmu_that_cannot_be_loaded_is_rejected(
    faulty: Faulty, points: list[ExpectedPoint]
) -> None:
    outcome = trial(faulty("clock.py", "class Clock", "1 / 0\nclass Clock"), points, 60.0)
    assert isinstance(outcome, Rejection)
    assert not outcome.scene


def test_a_probe_sees_an_output_that_is_wrong_in_the_run_only(
    faulty: Faulty, python_fmu: Path
) -> None:
    run = {"drive_periods": 2, "steps_per_period": 8}
    content = {"name": "probe", "title": "Nothing but its outputs", "run": run}
    probe = scene_from(content, "probe")
    points = probe_points(python_fmu, [probe], 60.0)
    assert trial(python_fmu, points, 60.0) is None
    wrong = faulty("outputs.py", "view.now.psi - ratio", "view.now.psi + ratio")
    outcome = trial(wrong, points, 60.0)
    assert isinstance(outcome, Rejection)
    assert outcome.quantity in ("steady_velocity", "blocking_force")
