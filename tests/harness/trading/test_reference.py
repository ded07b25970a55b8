"""The reference of a problem."""

from __future__ import annotations

import pytest

from slider_resonator.trading.reference import find_reference
from tests.harness.trading.problems import STICKING, TABLE_1, problem

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
    assert not reference.sticks, "reversals follow each other without a stick"


def test_a_drive_weaker_than_friction_sticks() -> None:
    assert find_reference(problem(STICKING, max_periods=3)).sticks


def test_a_slider_that_friction_holds_stays_where_it_is() -> None:
    reference = find_reference(problem(HELD_BY_FRICTION))
    assert not reference.windows.position.any()
