"""The reference of a problem, and its uncertainty."""

from __future__ import annotations

import numpy as np
import pytest

from slider_resonator.references.resolved import taylor
from slider_resonator.trade.problem import REFERENCE_STEPS
from slider_resonator.trade.reference import find_reference
from tests.harness.trade.problems import RAMP, STICKING, TABLE_1, TURNS_BACK, problem

HELD_BY_FRICTION = """
[device]
base_amplitude = 0.0
normal_amplitude = 0.0
[inputs]
load = { ramp = [[0.0, 0.0], [0.005, 0.1]] }
[run]
drive_periods = 4
steps_per_period = 4
"""


def test_table_1_by_a_run_and_by_shooting() -> None:
    reference = find_reference(problem(TABLE_1, max_periods=2))
    assert reference.steady_velocity == pytest.approx(0.12666700, rel=1e-7)
    assert reference.blocking_force == pytest.approx(0.0851861, rel=1e-6)
    assert reference.uncertainty == 0.0, "inputs that do not vary are held without an error"
    assert not reference.sticks, "reversals follow each other without a stick"


def test_a_drive_weaker_than_friction_sticks() -> None:
    assert find_reference(problem(STICKING, max_periods=3)).sticks


def test_a_ramp_is_followed_without_an_error() -> None:
    assert find_reference(problem(RAMP)).uncertainty == 0.0


def test_the_uncertainty_is_what_finer_steps_would_change() -> None:
    ramp = problem(TURNS_BACK)
    usual, fine = (
        taylor.simulate(ramp.device, ramp.reference_inputs(16, steps), ramp.readings(16)).position
        for steps in (REFERENCE_STEPS, 8 * REFERENCE_STEPS)
    )
    off = np.abs(usual - fine).max() / np.abs(fine).max()
    reported = find_reference(ramp).uncertainty
    assert off / 3.0 < reported < 5.0 * off, f"{reported:.1e} is reported, {off:.1e} would change"


def test_a_slider_that_friction_holds_is_known_exactly() -> None:
    reference = find_reference(problem(HELD_BY_FRICTION))
    assert reference.uncertainty == 0.0, "0 of nothing, not 0 / 0"
    assert not reference.windows.position.any()
