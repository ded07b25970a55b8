from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from threading import Event

import pytest

from slider_resonator.errors import FmuError
from studies.mutants.archive import PythonFmu, read_python_fmu
from studies.mutants.bench import Judging, bench_of
from studies.mutants.trial import BenchPoint, Tried, trial
from tests.harness import faulty_fmus
from tests.harness.scene_text import read_scene

pytestmark = pytest.mark.isolated

Outcome = Callable[[str, str, str], Tried]
FORCE = "self.drive, self.arc = force"


@pytest.fixture(scope="module")
def bench(python_fmu: Path, tmp_path_factory: pytest.TempPathFactory) -> list[BenchPoint]:
    scene = read_scene(faulty_fmus.scene(tmp_path_factory.mktemp("scene")))
    return bench_of(python_fmu, Judging([scene], time_limit=60.0))


@pytest.fixture
def outcome(python_fmu: Path, bench: list[BenchPoint], tmp_path: Path) -> Outcome:
    fmu: PythonFmu = read_python_fmu(python_fmu)

    def of(file: str, old: str, new: str) -> Tried:
        assert old in fmu.modules[file]
        out = tmp_path / "faulty.fmu"
        fmu.write(out, {fmu.path_of(file): fmu.modules[file].replace(old, new, 1)})
        return trial(out, bench, 3.0, Event())

    return of


def test_the_original_passes_and_does_not_differ(python_fmu: Path, bench: list[BenchPoint]) -> None:
    assert trial(python_fmu, bench, 60.0, Event()) == Tried(None, differs=False)
    assert bench[0].cost > 0.0


def test_a_failed_check_rejects(outcome: Outcome) -> None:
    rejection = outcome("device.py", FORCE, FORCE.replace("force", "1.01 * force")).rejection
    assert rejection is not None
    assert (rejection.scene, rejection.quantity) == ("short", "position")
    assert "off by" in rejection.reason


@pytest.mark.slow
@pytest.mark.parametrize(("error", "differs"), [(3e-9, True), (1e-14, False)])
def test_small_changes_pass_and_smaller_ones_count_as_none(
    outcome: Outcome, error: float, differs: bool
) -> None:
    changed = FORCE.replace("force", f"{1.0 + error!r} * force")
    assert outcome("device.py", FORCE, changed) == Tried(None, differs)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("new", "reason"),
    [
        ("while True: pass", "no answer within the time limit"),
        ("import ctypes; ctypes.string_at(0)", "crashed in fmi2DoStep"),
        ("raise RuntimeError('broken')", "broken"),
    ],
)
def test_a_hang_a_crash_and_an_error_reject(outcome: Outcome, new: str, reason: str) -> None:
    first = "    turn = tau / LONGEST_ARC * arc\n"
    rejection = outcome("events.py", first, f"{first}    {new}\n").rejection
    assert rejection is not None
    assert reason in rejection.reason
    assert not rejection.quantity


@pytest.mark.slow
def test_an_fmu_that_cannot_be_loaded_is_rejected(outcome: Outcome) -> None:
    rejection = outcome("budget.py", "class Clock", "1 / 0\nclass Clock").rejection
    assert rejection is not None
    assert not rejection.scene


@pytest.mark.slow
def test_an_fmu_that_is_rejected_unchanged_is_refused(python_fmu: Path, tmp_path: Path) -> None:
    fmu = read_python_fmu(python_fmu)
    faulty = tmp_path / "faulty.fmu"
    module = fmu.modules["device.py"].replace(FORCE, FORCE.replace("force", "1.01 * force"), 1)
    fmu.write(faulty, {fmu.path_of("device.py"): module})
    scene = read_scene(faulty_fmus.scene(tmp_path))
    with pytest.raises(FmuError, match=r"rejected before anything is changed: scene short: pos"):
        bench_of(faulty, Judging([scene], time_limit=60.0))
