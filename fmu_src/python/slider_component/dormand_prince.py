"""Steps of a velocity and its travel: Dormand and Prince's pair 5(4), and one near a balance."""

from collections.abc import Callable
from math import exp, expm1
from typing import NamedTuple

NO_DECAY = 1e-6
"""Decay of a velocity in a step below which its rate counts as constant."""

Rates = tuple[float, float]
"""Rates of the velocity and of the travel."""

RateFunction = Callable[[float, float], Rates]
"""Rates at a time and a velocity."""


class Step(NamedTuple):
    """Where a step of the solver leads.

    The velocity at its end and its change, the travel, the estimated `error` of the velocity, the
    rates at the end, and the `gain` there: the derivative of the acceleration by the velocity.
    """

    velocity: float
    change: float
    travel: float
    error: float
    rates: Rates
    gain: float


def dormand_prince(rates: RateFunction, t: float, v: float, h: float, first: Rates) -> Step:
    """Step by `h` from time `t` and velocity `v`, where the rates are `first`."""
    a1, x1 = first
    a2, _ = rates(t + h / 5, v + h * a1 / 5)
    a3, x3 = rates(t + 3 * h / 10, v + h * (3 * a1 + 9 * a2) / 40)
    a4, x4 = rates(t + 4 * h / 5, v + h * (44 * a1 / 45 - 56 * a2 / 15 + 32 * a3 / 9))
    by_5 = 19372 * a1 / 6561 - 25360 * a2 / 2187 + 64448 * a3 / 6561 - 212 * a4 / 729
    a5, x5 = rates(t + 8 * h / 9, v + h * by_5)
    by_6 = 9017 * a1 / 3168 - 355 * a2 / 33 + 46732 * a3 / 5247 + 49 * a4 / 176 - 5103 * a5 / 18656
    before = v + h * by_6
    a6, x6 = rates(t + h, before)
    slope = 35 * a1 / 384 + 500 * a3 / 1113 + 125 * a4 / 192 - 2187 * a5 / 6784 + 11 * a6 / 84
    end = v + h * slope
    a7, x7 = rates(t + h, end)
    by_error = 71 * a1 / 57600 - 71 * a3 / 16695 + 71 * a4 / 1920 - 17253 * a5 / 339200
    error = h * abs(by_error + 22 * a6 / 525 - a7 / 40)
    travel = 35 * x1 / 384 + 500 * x3 / 1113 + 125 * x4 / 192 - 2187 * x5 / 6784 + 11 * x6 / 84
    gain = (a7 - a6) / (end - before) if end != before else 0.0
    return Step(end, h * slope, h * travel, error, (a7, x7), gain)


def simpson_error(
    rates: RateFunction, t: float, v: float, h: float, first: Rates, step: Step
) -> float:
    """Error of the velocity over a step by Simpson's rule, with one more rate in the middle.

    Where rates have a kink, the error of the pair is small by accident now and then, but not both.
    """
    (a1, _), (a7, _) = first, step.rates
    middle, _ = rates(t + h / 2, v + step.change / 2 + h * (a1 - a7) / 8)
    return abs(step.change - h * (a1 + 4 * middle + a7) / 6)


def linear_step(
    rates: RateFunction,
    t: float,
    v: float,
    h: float,
    first: Rates,
    gain: float,
    max_change: float,
) -> Step | None:
    """Step near a balance, where the acceleration is linear in the velocity, with slope `gain`.

    However long `h` is. The acceleration at the end confirms it. None for a larger change of the
    velocity than `max_change`.
    """
    z = h * min(0.0, gain)
    decayed = exp(z)
    mean = expm1(z) / z if z < -NO_DECAY else 1.0
    change = h * first[0] * mean
    if not abs(change) <= max_change:
        return None
    end = rates(t + h, v + change)
    weight = (mean - decayed) / (1.0 - decayed) if z < -NO_DECAY else 0.5
    travel = h * (end[1] + weight * (first[1] - end[1]))
    error = h * mean * abs(end[0] - decayed * first[0])
    return Step(v + change, change, travel, error, end, gain)


def step_growth(error: float, tolerance: float) -> float:
    """Factor by which the next step may be longer or shorter than one with this error."""
    growth = 0.9 * (tolerance / error) ** 0.2 if error > 0.0 else 5.0
    return min(5.0, max(0.2, growth))
