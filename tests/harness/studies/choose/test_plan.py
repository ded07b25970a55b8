"""What a run asks of the FMU, counted on its schedule."""

from __future__ import annotations

import pytest

from slider_resonator.studies.choose.plan import Plan, plan_of
from tests.harness.scene_text import scene_of

RUN = "[run]\nstop_time = 1.0\nstep_size = 0.1\n"


def planned(text: str) -> Plan:
    return plan_of(scene_of(text).schedule())


def test_jumps_are_settings_and_kicks_and_only_those_of_the_lead_turn_orbits() -> None:
    plan = planned(
        "[inputs]\nload = { steps = [[0, 0], [0.25, 0.1]] }\n"
        f"phase = {{ steps = [[0, 0], [0.33, 0.1], [0.55, 0.2]] }}\n{RUN}"
    )
    assert (plan.steps, plan.settings) == (13, 3)
    assert plan.kicks == pytest.approx([0.25, 0.33, 0.55])
    assert plan.led == pytest.approx([0.33, 0.55])
    assert not plan.lines


def test_a_line_that_is_held_kicks_at_every_point_and_one_passed_on_at_its_corners() -> None:
    phase = "[inputs]\nphase = { ramp = [[0, 0], [0.45, 0.3], [1.0, 0.1]] }\n"
    held, passed = planned(f"{phase}{RUN}"), planned(f"{phase}{RUN}interpolate = true\n")
    assert (held.steps, held.settings, len(held.kicks)) == (10, 9, 9)
    assert passed.steps == 11, "the corner is a communication point"
    assert passed.settings == 2 * 10, "values and derivatives"
    assert passed.kicks == pytest.approx([0.45])
    assert passed.led == pytest.approx([0.45])
    assert passed.lines
    assert passed.turning


def test_a_parameter_that_jumps_turns_orbits() -> None:
    plan = planned(f"{RUN}[tuning]\nfriction_coefficient = {{ steps = [[0, 0.1], [0.5, 0.2]] }}\n")
    assert (plan.settings, len(plan.kicks), len(plan.led)) == (1, 1, 1)
