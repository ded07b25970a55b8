"""The first zero of a smooth signal, by a search that cannot miss one.

From a point where the signal f is positive, f(t + d) >= f + f' d - B d^2 / 2 while B bounds |f''|.
The search advances by the zero of that parabola: it approaches the first zero from the left and
cannot step across it, nor across a pair of close zeros. Once f'^2 > 2 B f holds with f' < 0, the
next zero is simple and Newton's method converges to it (Kantorovich), so the search ends there.

A zero that is expected at some time is looked for there at once. It is the first one if the
parabola from the start and that from the zero backwards leave no gap between them.
"""

from collections.abc import Callable
from math import inf, sqrt
from typing import NamedTuple

Signal = Callable[[float], tuple[float, float, float]]
"""t [s] -> (f, f', bound of |f''| from t on up to the limit of the search)."""


class Watch(NamedTuple):
    """A signal whose first zero ends the mode, with the scales that its search needs.

    `noise` is the rounding error of its values, `fastest` [rad/s] its highest frequency. A zero may
    be `expected` at a time [s].
    """

    signal: Signal
    noise: float
    fastest: float
    expected: float = 0.0


SHORTEST = 1e-7
"""Shortest step of the search, as an angle [rad] of the highest frequency. Two zeros closer than
that enclose a dip within rounding, and count as a touch."""

SHORT = 0.01
"""Steps [rad] below this count as short. After `PATIENCE` of them the shortest step doubles, up to
this, which bounds the work on signals that stay within rounding of zero."""

PATIENCE = 20

MAX_REFINEMENTS = 80
MAX_EXPECTING_STEPS = 4

RESOLUTION = 1e-16
"""Angle [rad] of the highest frequency to which zeros are located."""

SURE = 0.99
"""Share of the interval that two parabolas cover that is relied on: a margin for rounding."""


def first_zero(watch: Watch, limit: float) -> float | None:
    """Time of the first downward zero in [0, limit) [s], or None.

    The signal is non-negative at 0, up to its noise.
    """
    signal, noise, fastest, expected = watch
    zero, steepness = inf, 0.0
    if 0.0 < expected < limit:
        zero, steepness = _zero_near(watch, limit)
    t = before = 0.0
    shortest, short_steps = SHORTEST / fastest, 0
    while t < limit:  # not a number ends the search, too
        value, slope, bound = signal(t)
        margin = 2.2 * (value + noise)
        if value <= noise:
            if value < -noise and t > before:
                # Only a step of the shortest length can get here.
                return _refined(watch, before, t, noise)
            value, margin = noise, 16.0 * noise
        root = sqrt(slope * slope + 2.0 * bound * value)
        if slope < 0.0:
            if slope * slope > bound * margin:
                found = _refined(watch, t, inf, 0.0)
                return found if found < limit else None
            step = 2.0 * value / (root - slope)
        else:
            step = (slope + root) / bound if bound > 0.0 else inf
        # The parabola from the zero backwards must cover the rest of the way, beyond rounding.
        rest = zero - t
        if 0.0 < rest < inf and bound * rest < SURE * (slope + root - 2.0 * steepness):
            return zero
        if step * fastest < SHORT:
            short_steps += 1
            if short_steps % PATIENCE == 0:
                shortest = min(2.0 * shortest, SHORT / fastest)
        before = t
        t += max(step, shortest)
    return None


def _zero_near(watch: Watch, limit: float) -> tuple[float, float]:
    """The downward zero near the expected one, by Newton's method in a few steps, and the slope.

    Infinite if none is found, or beyond `limit`, where the bound of the signal may not hold.
    """
    t = watch.expected
    for _ in range(MAX_EXPECTING_STEPS):
        value, slope, bound = watch.signal(t)
        if not slope < 0.0:
            break
        step = -value / slope
        t += step
        if not 0.0 < t < limit:
            break
        # The next step would be below the resolution.
        if bound * step * step * watch.fastest <= -slope * RESOLUTION:
            return (t, slope) if slope * slope > 16.0 * watch.noise * bound else (inf, slope)
    return inf, 0.0


def _refined(watch: Watch, low: float, high: float, noise: float) -> float:
    """Where the signal falls through -noise after `low` [s], by Newton's method.

    It stays within the bracket that ends at `high`, where the signal is below that, if that is
    finite: otherwise Newton's method is known to converge.
    """
    resolution = RESOLUTION / watch.fastest
    t = low
    for _ in range(MAX_REFINEMENTS):
        value, slope, bound = watch.signal(t)
        value += noise
        low, high = (max(low, t), high) if value > 0.0 else (low, min(high, t))
        following = t - value / slope if slope < 0.0 else inf
        if not low <= following <= high:
            if high == inf:
                break
            following = 0.5 * (low + high)
        step, t = following - t, following
        # The next step would be below the resolution.
        if bound * step * step <= -slope * resolution or abs(step) <= resolution:
            break
    return t
