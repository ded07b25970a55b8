"""The work of a communication step: what its parts take adds up."""

from __future__ import annotations

import math
from unittest.mock import Mock

import pytest

from fmu_src.python.slider_component import events
from fmu_src.python.slider_component.budget import Budget
from fmu_src.python.slider_component.constants import MAX_STEP_LEGS, PYTHON_SLOWDOWN
from fmu_src.python.slider_component.device import Inputs
from fmu_src.python.slider_component.dormand_prince import Reached
from fmu_src.python.slider_component.friction_laws import friction_law_of
from fmu_src.python.slider_component.held import hold
from fmu_src.python.slider_component.law import law_of
from fmu_src.python.slider_component.motion import State
from fmu_src.python.slider_component.refusal import Refusal
from fmu_src.python.slider_component.slow_pass import SlowPass
from tests.fmu_src.orbit_devices import TABLE_1

MAX_LEGS = MAX_STEP_LEGS // PYTHON_SLOWDOWN
PERIOD = math.tau / TABLE_1.drive_frequency
MAX_STEPS = 100


def slow_pass() -> SlowPass:
    return SlowPass(lambda _t, v: -v, 1.0, 1e-9, 0.01, may_settle=False, max_steps=MAX_STEPS)


def test_resolved_motion_spends_its_legs_and_stops_where_the_budget_ends() -> None:
    moment = law_of(TABLE_1, Inputs()).start(State(0.0, 0.0, 0.0), 0.0)
    friction, held = friction_law_of(0), hold(TABLE_1, Inputs())
    budget = Budget(1.0)
    events.advance(friction, held, moment, 10.0 * PERIOD, budget)
    legs = budget.spent * MAX_LEGS
    assert 20.0 <= legs <= 40.0, "two legs or some more in a turn"
    budget.spent = 1.0 - 0.5 * budget.spent
    with pytest.raises(Refusal, match=f"= 1.0 refused: it takes more work than {MAX_LEGS} legs"):
        events.advance(friction, held, moment, 10.0 * PERIOD, budget)


def test_motion_of_too_many_legs_is_refused_before_it_begins() -> None:
    """At 3.5e299 rad/s the velocity underflows in a leg, whose search takes thousands of steps."""
    inputs = Inputs(frequency_ratio=1e296)
    moment = law_of(TABLE_1, inputs).start(State(0.0, 0.0, 0.0), 0.0)
    friction = Mock(wraps=friction_law_of(0))
    with pytest.raises(Refusal, match=f"it takes more work than {MAX_LEGS} legs of motion"):
        events.advance(friction, hold(TABLE_1, inputs), moment, 1e-3, Budget(1e-3))
    friction.follow.assert_not_called()


def test_slow_motion_has_the_steps_that_other_work_left() -> None:
    whole = Budget(5.0)
    reached = slow_pass().reach(2.0, Reached(0.0, 1.0, 0.0, 0.01), whole)
    assert whole.spent == pytest.approx(reached.tried / MAX_STEPS)
    slow_pass().reach(2.0, Reached(0.0, 1.0, 0.0, 0.01), Budget(5.0, spent=0.99 - whole.spent))
    with pytest.raises(Refusal, match=f"= 5.0 refused: it takes more work than {MAX_STEPS} steps"):
        slow_pass().reach(2.0, Reached(0.0, 1.0, 0.0, 0.01), Budget(5.0, spent=1.01 - whole.spent))
