"""What a run asks of the FMU, counted on its schedule."""

from __future__ import annotations

import pytest

from slider_resonator.studies.choose.plan import MAX_STAYS, Plan, plan_of
from tests.harness.scene_text import scene_of

RUN = "[run]\nstop_time = 1.0\nstep_size = 0.1\n"


def planned(text: str) -> Plan:
    return plan_of(scene_of(text).schedule(), 0.01)


def test_jumps_are_settings_and_kicks_and_those_of_the_phase_begin_a_stay() -> None:
    plan = planned(
        "[inputs]\nload = { steps = [[0, 0], [0.25, 0.1]] }\n"
        f"phase = {{ steps = [[0, 0], [0.33, 0.1], [0.55, 0.0]] }}\n{RUN}"
    )
    assert (plan.steps, plan.settings, plan.kicks) == (13, 3, 3)
    assert [stay.periods for stay in plan.stays] == pytest.approx([33.0, 22.0, 45.0])
    leads = [stay.lead for stay in plan.stays]
    assert leads[0] == leads[2] != leads[1], "back at a phase that was visited"
    assert not any(stay.drifts for stay in plan.stays)


def test_a_line_that_is_held_kicks_at_every_point_and_one_passed_on_at_its_corners() -> None:
    phase = "[inputs]\nphase = { ramp = [[0, 0], [0.45, 0.3], [1.0, 0.1]] }\n"
    held, passed = planned(f"{phase}{RUN}"), planned(f"{phase}{RUN}interpolate = true\n")
    assert (held.steps, held.settings, held.kicks, len(held.stays)) == (10, 9, 9, 10)
    assert passed.steps == 11, "the corner is a communication point"
    assert passed.settings == 2 * 10, "values and derivatives"
    assert (passed.kicks, len(passed.stays)) == (1, 2)
    assert all(stay.drifts for stay in passed.stays)
    assert [stay.bends for stay in passed.stays] == [False, True], "no value jumps at the corner"
    assert not any(stay.bends for stay in held.stays)


def test_a_parameter_that_jumps_begins_a_stay_and_a_drive_shakes_the_resonator() -> None:
    plan = planned(
        f"{RUN}[tuning]\nfriction_coefficient = {{ steps = [[0, 0.1], [0.5, 0.2]] }}\n"
        "base_amplitude = { steps = [[0, 1e-4], [0.7, 2e-4]] }\n"
    )
    assert (plan.settings, plan.kicks, plan.tunings, plan.shakes) == (2, 2, 2, 1)
    assert [stay.driven for stay in plan.stays] == [False, False, True]


def test_beats_are_the_turns_of_the_slow_phase() -> None:
    """A ratio of 1.02 turns once in 50 periods; along a line from 1 half as often."""
    assert planned(f"[inputs]\nfrequency_ratio = 1.02\n{RUN}").beats == pytest.approx(2.0)
    chirp = "[inputs]\nfrequency_ratio = { ramp = [[0, 1.0], [1.0, 1.02]] }\n"
    plan = planned(f"{chirp}{RUN}interpolate = true\n")
    assert plan.beats == pytest.approx(1.0)
    assert plan.chirped == pytest.approx(100.0)


def test_very_many_changes_count_as_fewer_stays() -> None:
    run = "[run]\nstop_time = 1.0\nstep_size = 1e-4\n"
    plan = planned(f"[inputs]\nphase = {{ ramp = [[0, 0], [1.0, 1.0]] }}\n{run}")
    assert plan.kicks == 9999
    assert len(plan.stays) <= MAX_STAYS
    assert sum(stay.count for stay in plan.stays) == pytest.approx(plan.kicks, rel=0.01)
    assert sum(stay.periods for stay in plan.stays) == pytest.approx(100.0)
