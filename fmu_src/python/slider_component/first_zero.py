"""The first zero of a smooth signal, found so that none can be passed over.

From a point where the signal f is positive, f(t + d) >= f + f' d - B d^2 / 2 while B bounds |f''|.
The search advances by the zero of that parabola: it approaches the first zero from the left and
cannot step across it, nor across a pair of close zeros. Once f'^2 > 2 B f holds with f' < 0, the
next zero is simple and Newton's method converges to it (Kantorovich), so the search ends there.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

Signal = Callable[[float], tuple[float, float, float]]
"""t [s] -> (f, f', bound of |f''| from t on, over the horizon that goes with the signal)."""


class Watch(NamedTuple):
    """A signal whose first zero ends the mode, with the scales that its search needs.

    `noise` is the rounding error of its values, `fastest` [rad/s] its highest frequency, and
    `horizon` [s] how far ahead its curvature bound holds.
    """

    signal: Signal
    noise: float
    fastest: float
    horizon: float


FLOOR_DOUBLING = 1000
"""Evaluations after which the shortest step doubles: bounds the work on signals that stay within
rounding of zero."""


def first_zero(watch: Watch, limit: float, start: float = 0.0) -> float | None:
    """Time of the first downward zero in [start, limit) [s], or None.

    The signal is non-negative at `start`. Two zeros closer than 1e-7 / fastest enclose a dip
    within rounding and count as a touch, which is no zero.
    """
    signal, noise, fastest, horizon = watch
    t = start
    floor = 1e-7 / fastest
    evaluations = 0
    while t < limit:
        value, slope, bound = signal(t)
        evaluations += 1
        if slope < 0.0:
            square = slope * slope
            if value <= noise:
                if value < -noise or square > 16.0 * noise * bound:
                    return t
                value = noise
            elif square > 2.2 * bound * (value + noise):
                root = _newton(signal, t, value, slope, fastest)
                return root if root < limit else None
        elif value < noise:
            value = noise
        root_term = math.sqrt(slope * slope + 2.0 * bound * value)
        if slope < 0.0:
            step = 2.0 * value / (root_term - slope)
        elif bound > 0.0:
            step = (slope + root_term) / bound
        else:
            step = horizon
        if evaluations % FLOOR_DOUBLING == 0:
            floor *= 2.0
        t += min(max(step, floor), horizon)
    return None


def _newton(signal: Signal, t: float, value: float, slope: float, fastest: float) -> float:
    """Newton's method from a point that satisfies Kantorovich's condition."""
    resolution = 1e-16 / fastest
    for _ in range(60):
        step = -value / slope
        t += step
        if abs(step) <= resolution:
            break
        value, slope, bound = signal(t)
        if slope >= 0.0:
            break
        remaining = -value / slope
        if bound * remaining * remaining <= -slope * resolution:
            t += remaining
            break
    return t
