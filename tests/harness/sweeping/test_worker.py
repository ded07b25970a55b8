from __future__ import annotations

import pytest

from slider_resonator.fmu.instance import Instance
from slider_resonator.sweeping.measures import FEW, Run, Task, measure_point, prove_points

TASK = Task(("friction_coefficient",), (), ("steady_velocity",), 20, Run(1, 1, 0))
BOTH = Task(("phase",), (), ("blocking_force", "velocity.rms"), 20, Run(2, 16, 0))


def test_a_point_that_fails_is_a_row_with_its_error_and_the_next_is_sound(
    instance: Instance,
) -> None:
    failed = measure_point(instance, TASK, (0, (-1.0,)), {})
    sound = measure_point(instance, TASK, (1, (0.1,)), {})
    assert failed[:2] == (0, [None, None])
    assert "friction_coefficient = -1" in str(failed[2])
    assert sound[1][1] == "steady"


def test_what_is_proved_is_not_searched(instance: Instance) -> None:
    point = (7, (0.4,))
    (proved,) = prove_points(instance, BOTH, [point])
    assert isinstance(proved, dict), "a run is to be made"
    number, cells, error = measure_point(instance, BOTH, point, proved)
    assert (number, cells[:2], error) == (7, [proved["blocking_force"], "blocked"], None)
    assert cells[2] == pytest.approx(measure_point(instance, BOTH, point, {})[1][2], rel=0)


def test_few_points_that_are_not_proved_are_searched_at_once(instance: Instance) -> None:
    points = [(0, (-1.0,)), (1, (0.1,))]
    refused, sound = prove_points(instance, TASK, points)
    assert refused == measure_point(instance, TASK, points[0], {})
    assert sound[2] is None  # type: ignore[index]
    law = Task(("friction_law",), (), ("steady_velocity",), 20, Run(1, 1, 0))
    many = [(number, (1.0,)) for number in range(FEW + 1)]
    assert prove_points(instance, law, many) == [{}] * len(many)
