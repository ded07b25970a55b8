from __future__ import annotations

from math import pi

import pytest

from harness.drive import Instance
from harness.errors import FmuError
from harness.paper.mapping import coulomb_case, lugre_case
from harness.paper.measure import (
    blocking_load,
    course,
    settled_velocity,
    steady_velocity,
)
from harness.references import uniform_average
from harness.references.averaged_lugre import LugreCase


def test_course_covers_the_span(instance: Instance) -> None:
    run = course(instance, coulomb_case(1.0, 10.0), 2.0, 8)
    assert run.time.tolist() == [0.25 * k for k in range(9)]
    assert run.position[0] == 0.0
    assert set(run.plain()) == {"time", "position", "velocity"}


def test_settling_meets_shooting_from_a_start_far_off(instance: Instance) -> None:
    values = coulomb_case(1.0, 200.0, 0.8, 1.0)
    shot = steady_velocity(instance, values)
    for guess in (shot + 0.2, shot - 0.3):
        assert settled_velocity(instance, values, guess) == pytest.approx(shot, abs=2e-5), (
            "extrapolated decay and fixed point are the same motion"
        )


def test_no_steady_motion_is_an_error_with_its_reason(instance: Instance) -> None:
    values = {**coulomb_case(1.0, 200.0), "load": 2.0}
    with pytest.raises(FmuError, match="friction"):
        steady_velocity(instance, values)
    with pytest.raises(FmuError, match="not settled"):
        settled_velocity(instance, values, 0.0, turns=0.05)


@pytest.mark.slow
@pytest.mark.parametrize("stiffness", [10.0, 1000.0, 1e5])
def test_lugre_settles_where_the_uniform_average_says(instance: Instance, stiffness: float) -> None:
    case = LugreCase(phase=pi / 2.0)
    average = uniform_average.steady_velocity(case, stiffness, 1000.0)
    values = lugre_case(1.0, 1000.0, stiffness)
    assert settled_velocity(instance, values, average) == pytest.approx(average, abs=2e-3)
    blocked = uniform_average.blocking_load(case, stiffness, 1000.0)
    assert blocking_load(instance, values, blocked) == pytest.approx(blocked, abs=2e-3)
