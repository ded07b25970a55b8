from __future__ import annotations

from slider_resonator.fmu.instance import Instance
from slider_resonator.sweeping.measures import Run, Task, measure_points

TASK = Task(("friction_coefficient",), (), ("steady_velocity",), 20, Run(1, 1, 0))


def test_a_point_that_fails_is_a_row_with_its_error_and_the_next_is_sound(
    instance: Instance,
) -> None:
    failed, sound = measure_points(instance, TASK, [(0, (-1.0,)), (1, (0.1,))])
    assert failed[:2] == (0, [None, None])
    assert "friction_coefficient = -1" in str(failed[2])
    assert sound[1][1] == "steady"
