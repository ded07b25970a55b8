from __future__ import annotations

from math import pi, tau

import numpy as np
import pytest

from slider_resonator.fmu.instance import Instance
from slider_resonator.steady.steady_velocity import find_steady
from slider_resonator.sweeping.measures import STATISTICS, Run, Task, measure, unit

TURN = np.linspace(0.0, tau, 65)


@pytest.mark.parametrize(
    ("statistic", "expected"),
    [
        ("mean", 3.0),
        ("rms", (9.0 + 2.0) ** 0.5),
        ("minimum", 1.0),
        ("maximum", 5.0),
        ("peak_to_peak", 4.0),
        ("last", 3.0),
    ],
)
def test_statistics_of_an_offset_sine(statistic: str, expected: float) -> None:
    assert STATISTICS[statistic](3.0 + 2.0 * np.sin(TURN)) == pytest.approx(expected, rel=1e-12)


def _task(*measures: str, names: tuple[str, ...] = ("phase",), run: Run | None = None) -> Task:
    return Task(names, (("load", 0.01),), measures, 20, run or Run(10, 16, 0))


def test_measures_by_shooting_are_those_of_the_commands(instance: Instance) -> None:
    velocity, status = measure(instance, _task("steady_velocity"), (0.4,), {})
    alone = find_steady(instance, {"phase": 0.4, "load": 0.01})
    assert (velocity, status) == (alone.steady_velocity, "steady")
    force, status = measure(instance, _task("blocking_force"), (0.0,), {})
    assert force == pytest.approx(0.0851861, rel=1e-5), "measured for table 1"
    assert status == "blocked"


def test_a_motion_that_does_not_repeat_has_a_status_and_no_value(instance: Instance) -> None:
    task = _task("steady_velocity", names=("frequency_ratio",))
    assert measure(instance, task, (1.37,), {}) == [None, "no_common_period"]


def test_statistics_are_those_of_the_run_that_was_asked_for(instance: Instance) -> None:
    task = _task(
        "position.last",
        "velocity.mean",
        "normal_force.mean",
        names=("drive_frequency",),
        run=Run(40, 64, 20),
    )
    position, velocity, force = measure(instance, task, (7000.0,), {})
    period = tau / 7000.0
    instance.start({"load": 0.01, "drive_frequency": 7000.0})
    instance.step_to(20 * period)
    before = instance.value("position")
    instance.step_to(40 * period)
    assert position == pytest.approx(instance.value("position"), rel=1e-9)
    travelled = instance.value("position") - before
    assert velocity == pytest.approx(travelled / (20 * period), rel=1e-2)
    assert force == pytest.approx(1.0, rel=1e-9), "the preload, over whole periods"


def test_a_point_does_not_depend_on_those_before(instance: Instance) -> None:
    task = _task("steady_velocity", "velocity.rms")
    first = measure(instance, task, (0.4,), {})
    measure(instance, task, (pi / 2,), {})
    assert measure(instance, task, (0.4,), {}) == first


def test_columns_and_units() -> None:
    task = _task("steady_velocity", "position.rms", names=("fidelity", "phase"))
    assert dict(task.columns) == {
        "point": int,
        "fidelity": int,
        "phase": float,
        "steady_velocity": float,
        "steady_velocity_status": str,
        "position.rms": float,
        "error": str,
    }
    assert [unit(name) for name in task.measures] == ["m/s", "m"]
