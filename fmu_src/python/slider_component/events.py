"""The loop over events: resolved motion under any friction law, leg by leg."""

from __future__ import annotations

from math import inf, tau

from .budget import Budget
from .clock import Clock
from .constants import MAX_STEP_LEGS, PYTHON_SLOWDOWN
from .contact import LIFTED, time_to_switch
from .friction_law import FrictionLaw
from .held import LONGEST_ARC, Held
from .moment import Moment
from .trace import Trace

MAX_LEGS = 20_000
"""Largest number of legs accepted in a turn of the fastest oscillation: several times as many as
presliding on the hardest bristles takes."""


def advance(
    friction: FrictionLaw,
    held: Held,
    moment: Moment,
    duration: float,
    budget: Budget,
    trace: Trace | None = None,
) -> Moment:
    """The moment `duration` > 0 [s] later, inputs held; a `trace` looks at the motion on its way.

    Raises Refusal for a motion of more legs than the budget has, or of too many in a turn.
    """
    plant, arc, window = held.plant, held.arc, held.window
    max_legs = MAX_STEP_LEGS // PYTHON_SLOWDOWN
    legs_left = budget.left(max_legs)
    turn = tau / LONGEST_ARC * arc
    if duration > legs_left * arc:
        raise budget.refusal(legs_left * arc, max_legs, "legs of motion")
    clock, remaining = Clock(duration), duration
    legs, all_legs, turn_began = 0, 0, 0.0
    departs = moment.state.velocity == 0.0
    now = moment.copied()
    now.enter(friction.mode(held, now))
    while remaining > 0.0:
        if clock.elapsed - turn_began > turn:
            legs, turn_began = 0, clock.elapsed
        legs += 1
        if legs > MAX_LEGS:
            what = "legs in a turn of the fastest oscillation"
            raise budget.refusal(clock.elapsed, MAX_LEGS, what)
        all_legs += 1
        if all_legs > legs_left:
            raise budget.refusal(clock.elapsed, max_legs, "legs of motion")
        switching, longest = inf, remaining if remaining < arc else arc
        if window is not None:
            chi, lifted = now.psi + plant.phase, now.mode == LIFTED
            switching = time_to_switch(window, chi, plant.normal_frequency, lifted)
            longest = min(longest, switching)
        leg = friction.follow(held, now, longest, switching, departs)
        if trace is not None:
            trace.look(leg, now, clock.elapsed)
        leg.finish(held, now)
        friction.succeed(held, leg, now, leg.zero_of is None and leg.t == switching)
        departs = now.state.velocity == 0.0 and now.mode != -leg.mode
        remaining = clock.advance(leg.t) if leg.t != remaining else 0.0
    budget.spend(all_legs, max_legs)
    if trace is not None:
        trace.look_at_end(now)
    return now
