"""What a run asks of the FMU, counted on its schedule."""

from __future__ import annotations

import pytest

from slider_resonator.choosing.plan import Plan, plan_of
from tests.harness.scene_text import scene_of

RUN = "[run]\nstop_time = 1.0\nstep_size = 0.1\n"


def planned(text: str) -> Plan:
    return plan_of(scene_of(text).schedule(), 0.01)


def test_jumps_are_settings_and_kicks() -> None:
    plan = planned(
        "[inputs]\nload = { steps = [[0, 0], [0.25, 0.1]] }\n"
        f"phase = {{ steps = [[0, 0], [0.33, 0.1], [0.55, 0.0]] }}\n{RUN}"
    )
    assert (plan.steps, plan.settings, plan.kicks) == (13, 3, 3)


def test_a_line_that_is_held_kicks_at_every_point_and_one_passed_on_at_its_corners() -> None:
    phase = "[inputs]\nphase = { ramp = [[0, 0], [0.45, 0.3], [1.0, 0.1]] }\n"
    held, passed = planned(f"{phase}{RUN}"), planned(f"{phase}{RUN}interpolate = true\n")
    assert (held.steps, held.settings, held.kicks) == (10, 9, 9)
    assert passed.steps == 11, "the corner is a communication point"
    assert passed.settings == 2 * 10, "values and derivatives"
    assert passed.kicks == 1


def test_a_parameter_that_jumps_kicks_and_a_drive_shakes_the_resonator() -> None:
    plan = planned(
        f"{RUN}[tuning]\nfriction_coefficient = {{ steps = [[0, 0.1], [0.5, 0.2]] }}\n"
        "base_amplitude = { steps = [[0, 1e-4], [0.7, 2e-4]] }\n"
    )
    assert (plan.settings, plan.kicks, plan.tunings, plan.shakes) == (2, 2, 2, 1)


def test_beats_are_the_turns_of_the_slow_phase() -> None:
    """A ratio of 1.02 turns once in 50 periods; along a line from 1 half as often."""
    assert planned(f"[inputs]\nfrequency_ratio = 1.02\n{RUN}").beats == pytest.approx(2.0)
    chirp = "[inputs]\nfrequency_ratio = { ramp = [[0, 1.0], [1.0, 1.02]] }\n"
    plan = planned(f"{chirp}{RUN}interpolate = true\n")
    assert plan.beats == pytest.approx(1.0)
    assert plan.chirped == pytest.approx(100.0)
