"""Points of a sweep: what is measured or proved, and what fails, hangs or crashes the FMU."""

from concurrent.futures import Future
from math import tau
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from slider_resonator.fmu.instance import Instance
from slider_resonator.fmu.isolation.process import Outcome
from slider_resonator.fmu.isolation.tasks import QUEUED, LocalProcesses
from slider_resonator.steady.searches import find_steady
from slider_resonator.sweeping import sweeping
from slider_resonator.sweeping.measures import (
    STATISTICS,
    Row,
    Run,
    Task,
    measure_point,
    prove_points,
)
from slider_resonator.sweeping.sweeping import run_points
from tests.harness.faulty_fmus import compiled

TURN = np.linspace(0.0, tau, 65)


EXPECTED = {"mean": 3.0, "rms": 11.0**0.5, "minimum": 1.0, "maximum": 5.0}
EXPECTED |= {"peak_to_peak": 4.0, "last": 3.0}


@pytest.mark.parametrize(("statistic", "expected"), EXPECTED.items())
def test_statistics_of_an_offset_sine(statistic: str, expected: float) -> None:
    assert STATISTICS[statistic](3.0 + 2.0 * np.sin(TURN)) == pytest.approx(expected, rel=1e-12)


def _task(*measures: str, names: tuple[str, ...] = ("phase",), run: Run | None = None) -> Task:
    return Task(names, (("load", 0.01),), measures, 20, run or Run())


def test_measures_by_shooting_are_those_of_the_commands(instance: Instance) -> None:
    velocity, status = measure_point(instance, _task("steady_velocity"), (0, (0.4,)), {})[1]
    alone = find_steady(instance, {"phase": 0.4, "load": 0.01})
    assert (velocity, status) == (alone.steady_velocity, "steady")
    force, status = measure_point(instance, _task("blocking_force"), (0, (0.0,)), {})[1]
    assert force == pytest.approx(0.0851861, rel=1e-5), "measured for table 1"
    assert status == "blocked"


def test_statistics_are_those_of_the_run_that_was_asked_for(instance: Instance) -> None:
    task = _task(
        "position.last",
        "velocity.mean",
        "normal_force.mean",
        names=("drive_frequency",),
        run=Run(drive_periods=40, steps_per_period=64, skip_periods=20),
    )
    position, velocity, force = measure_point(instance, task, (0, (7000.0,)), {})[1]
    period = tau / 7000.0
    instance.start({"load": 0.01, "drive_frequency": 7000.0})
    instance.step_to(20 * period)
    before = instance.value("position")
    instance.step_to(40 * period)
    assert position == pytest.approx(instance.value("position"), rel=1e-9)
    travelled = instance.value("position") - before
    assert velocity == pytest.approx(travelled / (20 * period), rel=1e-2)
    assert force == pytest.approx(1.0, rel=1e-9), "the preload, over whole periods"


TASK = Task(("friction_coefficient",), (), ("steady_velocity",), 20, Run())
BOTH = Task(("phase",), (), ("blocking_force", "velocity.rms"), 20, Run(drive_periods=2))


def test_failed_point_is_a_row_with_its_error_and_the_next_is_sound(instance: Instance) -> None:
    used = instance.slave
    failed = measure_point(instance, TASK, (0, (-1.0,)), {})
    assert instance.slave is not used, "whatever state the failure has left it in"
    sound = measure_point(instance, TASK, (1, (0.1,)), {})
    assert failed[:2] == (0, [None, None])
    assert "friction_coefficient = -1" in str(failed[2])
    assert sound[1][1] == "steady"


def test_what_is_proved_is_not_searched(instance: Instance) -> None:
    point = (7, (0.4,))
    (proved,) = prove_points(instance, BOTH, [point])
    assert isinstance(proved, dict)
    number, cells, error = measure_point(instance, BOTH, point, proved)
    assert (number, cells[:2], error) == (7, [proved["blocking_force"], "blocked"], None)
    assert cells[2] == pytest.approx(measure_point(instance, BOTH, point, {})[1][2], rel=0)


POINTS = [(number, (0.1 * (1 + number),)) for number in range(3)]


def rows_of(fmu: Path, time_limit: float, measure: str = "velocity.rms") -> list[Row]:
    task = Task(TASK.names, (), (measure,), 20, Run(drive_periods=1, steps_per_period=1))
    kept: list[Row] = []
    with LocalProcesses(fmu, time_limit) as processes:
        run_points(processes, task, POINTS, kept.extend)
    assert sorted(row[0] for row in kept) == [0, 1, 2], "each point is computed once"
    return sorted(kept)


def test_points_of_a_batch_are_kept_before_all_batches_are_proved(
    native_fmu: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sweeping, "BATCH", 2)
    points = [(number, (0.01 * number,)) for number in range(20)]
    done: list[str] = []

    class Noted(LocalProcesses):
        def submit(self, task: Any) -> Future[Outcome]:
            done.append(task.func.__name__)
            return super().submit(task)

    kept: list[Row] = []
    with Noted(native_fmu, 60.0) as processes:
        run_points(processes, BOTH, points, kept.extend)
    assert sorted(row[0] for row in kept) == [*range(20)]
    assert done.index("measure_point") <= QUEUED < done.count("prove_points") == 10


@pytest.mark.isolated
def test_point_over_the_time_limit_is_a_row(native_fmu: Path, tmp_path: Path) -> None:
    """Endless in the second run of a process."""
    slow = "static int set; if (set) { LOOP } set = 1;"
    fmu = compiled(native_fmu, tmp_path / "slow.fmu", f"IN_STEP={slow}", "VALUE=1.0")
    rows = rows_of(fmu, 1.0)
    assert [row[2] is None for row in rows] == [True, False, True], rows
    assert "no answer within the time limit of 1 s in fmi2DoStep" in str(rows[1][2])


@pytest.mark.isolated
def test_a_process_that_dies_once_costs_no_point(native_fmu: Path, tmp_path: Path) -> None:
    """The FMU crashes unless a file is there, which it makes before."""
    mark = tmp_path / "mark"
    once = f'if (!fopen("{mark}", "r")) {{ fopen("{mark}", "w"); CRASH }}'
    fmu = compiled(native_fmu, tmp_path / "once.fmu", f"IN_STEP={once}", "VALUE=1.0")
    assert all(row[2] is None for row in rows_of(fmu, 60.0))


@pytest.mark.slow
@pytest.mark.isolated
def test_predictions_that_hang_are_left_to_single_points(native_fmu: Path, tmp_path: Path) -> None:
    fmu = compiled(native_fmu, tmp_path / "hangs.fmu", "IN_STEP=LOOP", "VALUE=2.0")
    for _, cells, error in rows_of(fmu, 1.0, "steady_velocity"):
        assert cells == [None, None]
        assert "no answer within the time limit of 1 s" in str(error)
