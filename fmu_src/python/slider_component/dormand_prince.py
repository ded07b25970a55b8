"""Dormand and Prince's 5(4) pair for one velocity and the position that it sums up to."""

from __future__ import annotations

from collections.abc import Callable
from math import inf, isfinite
from typing import NamedTuple


class Reached(NamedTuple):
    """The end reached: time [s], velocity [m/s], displacement [m], and the step [s] to try next."""

    t: float
    velocity: float
    moved: float
    step: float


def integrate(
    acceleration: Callable[[float, float], float],
    now: Reached,
    end: float,
    tolerance: float,
    most: int,
    longest: float = inf,
) -> Reached:
    """Integrate to time `end` [s], or for at most `most` accepted and rejected steps.

    `acceleration(t, v)` [m/s^2]; `tolerance` [m/s] is allowed per step. `longest` [s] bounds steps:
    what repeats must not look constant to all stages.
    """
    t, velocity, displacement, step = now
    first = acceleration(t, velocity)
    for _ in range(most):
        if not t < end or not isfinite(velocity):
            break
        left = end - t
        v, h = velocity, min(step, longest, left)
        k1 = first
        k2 = acceleration(t + h / 5, v + h * k1 / 5)
        k3 = acceleration(t + 3 * h / 10, v + h * (3 * k1 + 9 * k2) / 40)
        k4 = acceleration(t + 4 * h / 5, v + h * (44 * k1 / 45 - 56 * k2 / 15 + 32 * k3 / 9))
        k5 = acceleration(
            t + 8 * h / 9,
            v + h * (19372 * k1 / 6561 - 25360 * k2 / 2187 + 64448 * k3 / 6561 - 212 * k4 / 729),
        )
        k6 = acceleration(
            t + h,
            v
            + h
            * (
                9017 * k1 / 3168
                - 355 * k2 / 33
                + 46732 * k3 / 5247
                + 49 * k4 / 176
                - 5103 * k5 / 18656
            ),
        )
        change = h * (
            35 * k1 / 384 + 500 * k3 / 1113 + 125 * k4 / 192 - 2187 * k5 / 6784 + 11 * k6 / 84
        )
        k7 = acceleration(t + h, v + change)
        error = h * abs(
            71 * k1 / 57600
            - 71 * k3 / 16695
            + 71 * k4 / 1920
            - 17253 * k5 / 339200
            + 22 * k6 / 525
            - k7 / 40
        )
        if not error > tolerance:
            # The weights of the pair, applied to the velocities at its stages.
            displacement += h * v + h * h * (
                35 * k1 / 384 + 50 * k3 / 159 + 25 * k4 / 192 - 243 * k5 / 6784
            )
            velocity, first = v + change, k7
            t = t + h if h < left else end
        growth = 0.9 * (tolerance / error) ** 0.2 if error > 0.0 else 5.0
        step = h * min(5.0, max(0.2, growth))
    return Reached(t, velocity, displacement, step)
