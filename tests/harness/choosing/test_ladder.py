from __future__ import annotations

from itertools import pairwise
from math import log2, pi

import pytest

from slider_resonator.choosing.ladder import BEAT_POINTS, FINEST, STEPS_PER_BEAT
from slider_resonator.choosing.probe import Probe
from slider_resonator.fmu.instance import Instance
from tests.harness.scene_text import scene_of

PERIOD = 2.0 * pi / 3500.0
RAMP = "[inputs]\nload = { ramp = [[0, 0], [0.1, 0.1]] }\n"


def ladder(instance: Instance, text: str) -> tuple[float, ...]:
    steps = Probe(instance, scene_of(text)).ladder
    return tuple(step for step in steps if step is not None)


@pytest.mark.parametrize(
    ("need", "step"), [("mean_velocity", 0.1), ("position", 0.003), ("event_times", 0.003)]
)
def test_steady_inputs_leave_one_step_the_longest_that_resolves_the_needs(
    instance: Instance, need: str, step: float
) -> None:
    run = f"[run]\nstop_time = 0.1\nstep_size = 0.003\n[need]\n{need} = {{ rel = 0.1 }}\n"
    assert ladder(instance, run) == (step,)


def test_inputs_that_vary_leave_powers_of_two_of_the_step(
    instance: Instance,
) -> None:
    run = f"{RAMP}[run]\nstop_time = 0.1\nstep_size = 0.003\n[need]\n"
    signal = ladder(instance, f"{run}position = {{ rel = 0.1 }}\n")
    number = ladder(instance, f"{run}mean_velocity = {{ rel = 0.1 }}\n")
    assert signal[0] == 0.003
    assert number[0] == 0.003 * 32
    assert number[-len(signal) :] == signal
    assert {log2(coarse / fine) for coarse, fine in pairwise(number)} == {1.0}
    assert PERIOD / FINEST <= number[-1] < 2.0 * PERIOD / FINEST


def test_a_beat_is_tried_from_few_steps_to_enough_for_its_form(instance: Instance) -> None:
    steps = ladder(
        instance,
        "[inputs]\nfrequency_ratio = 1.05\n[run]\ndrive_periods = 2000\nsteps_per_period = 0.1\n"
        "[need]\nbeat = { rel = 0.1 }\n",
    )
    fewest, most = STEPS_PER_BEAT
    assert 20.0 * PERIOD / (2.0 * fewest) < steps[0] <= 20.0 * PERIOD / fewest
    assert steps[-1] <= 20.0 * PERIOD / most
    assert steps[0] <= 2000.0 * PERIOD / BEAT_POINTS[0]
    assert {coarse / fine for coarse, fine in pairwise(steps)} == {2.0}


def test_inputs_that_go_on_as_straight_lines_leave_the_longest_step(instance: Instance) -> None:
    run = "[run]\nstop_time = 0.1\nstep_size = 0.003\ninterpolate = true\n[need]\n"
    assert ladder(instance, f"{RAMP}{run}mean_velocity = {{ rel = 0.1 }}\n") == (0.1,)
    assert ladder(instance, f"{RAMP}{run}position = {{ rel = 0.1 }}\n") == (0.003,)


def test_a_number_at_the_end_of_a_long_scene_is_tried_in_one_step_and_halves(
    instance: Instance,
) -> None:
    """An FMU bounds the work of a step."""
    run = "[run]\ndrive_periods = 70000\nsteps_per_period = 1\n[need]\n"
    steps = ladder(instance, f"{run}mean_velocity = {{ rel = 0.1 }}\n")
    assert [round(step / PERIOD) for step in steps] == [70_000, 35_000, 17_500, 8750]
