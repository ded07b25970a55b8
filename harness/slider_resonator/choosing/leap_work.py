"""The drive periods that averages of second order resolve or map: the others are leapt over."""

from __future__ import annotations

from math import ceil, inf, log

from slider_resonator.choosing.plan import Plan
from slider_resonator.choosing.scales import Scales, longest_memory

SHORTEST_LEAP = 64.0
"""Drive periods of a communication step that is resolved as a whole."""
PER_LEAP = 24.0
"""Drive periods that are resolved or mapped for a leap in one step of its solver."""
PER_SOLVER_STEP = 18.0
"""Those of each further step: six evaluations of three periods."""
SOLVER_STEP = 4.0
"""Step of the solver at a tolerance of 1, in times in which the slow motion changes."""
SETTLES = 12.0
"""Relaxation times after which a leap takes one step, however long it is."""
TRANSIENT = 1e-6
"""What is left of a transient where leaping begins, with a tolerance that allows no more."""
LEAP_TOLERANCE = 1e-10
"""Largest tolerance of LuGre friction in periods that are mapped."""


def resolved_periods(plan: Plan, scales: Scales, law: int, tolerance: float) -> float:
    """Return the drive periods that a run resolves or maps, all of them where nothing is leapt."""
    periods = plan.duration / scales.period
    step = periods / plan.steps
    if not scales.has_slow_motion or step <= SHORTEST_LEAP:
        return periods
    change = scales.relaxation / scales.period
    moving = min(periods, SETTLES * change * (1 + plan.kicks))
    if plan.beats:
        change, moving = min(change, periods / plan.beats), periods
    solver_step = SOLVER_STEP * tolerance**0.2 * change
    further = max(0, ceil(step / solver_step) - 1) if solver_step else inf
    starts = 1 + plan.kicks
    transients = starts * longest_memory(scales, law) * -log(max(tolerance, TRANSIENT))
    leaps = plan.steps * PER_LEAP + moving / step * PER_SOLVER_STEP * further
    return min(periods, transients + leaps)
