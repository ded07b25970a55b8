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
"""Steps [rad] below this count as short. After each of them the shortest step grows by `GROWTH`, up
to this, which bounds the work on signals that stay within rounding of zero."""

GROWTH = 1.035

MAX_NEWTON_STEPS = 80
"""Steps of Newton's method towards a zero that is simple, far more than it takes."""

MAX_EXPECTING_STEPS = 4
"""The same towards a zero that is expected."""

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
        # Beyond the limit the bound of the signal may not hold.
        zero, steepness = _newton(watch, expected, limit, MAX_EXPECTING_STEPS)
    t = before = 0.0
    shortest = SHORTEST / fastest
    while t < limit:  # not a number ends the search, too
        value, slope, bound = signal(t)
        margin = 2.2 * (value + noise)
        if value <= noise:
            if value < -noise and t > before:
                # Only a step of the shortest length can get here.
                return _bisected(watch, before, t)
            value, margin = noise, 16.0 * noise
        root = sqrt(slope * slope + 2.0 * bound * value)
        if slope < 0.0:
            if slope * slope > bound * margin:
                found, _ = _newton(watch, t, inf, MAX_NEWTON_STEPS)
                return found if found < limit else None
            step = 2.0 * value / (root - slope)
        else:
            step = (slope + root) / bound if bound > 0.0 else inf
        # The parabola from the zero backwards must cover the rest of the way, beyond rounding.
        rest = zero - t
        if (
            0.0 < rest < inf
            and bound * rest < SURE * (slope + root - 2.0 * steepness)
            and steepness * steepness > 16.0 * noise * bound
        ):
            return zero
        if step * fastest < SHORT:
            shortest = min(GROWTH * shortest, SHORT / fastest)
        before = t
        t += max(step, shortest)
    return None


def _newton(watch: Watch, t: float, limit: float, max_steps: int) -> tuple[float, float]:
    """The downward zero near `t` [s], by Newton's method, and the slope there.

    Infinite if none is found, or if the way to it leads beyond `limit`.
    """
    signal, noise, fastest, _ = watch
    for _ in range(max_steps):
        value, slope, bound = signal(t)
        if not slope < 0.0:
            break
        step = -value / slope
        t += step
        if t < 0.0:
            t = 0.0
        elif not t < limit:
            break
        # The next step would be below the resolution, or this one is rounding.
        if bound * step * step * fastest <= -slope * RESOLUTION or -noise <= value <= noise:
            return t, slope
    return inf, 0.0


def _bisected(watch: Watch, low: float, high: float) -> float:
    """Where the signal falls through -noise between `low` and `high` [s]."""
    while low < (middle := 0.5 * (low + high)) < high:
        low, high = (middle, high) if watch.signal(middle)[0] > -watch.noise else (low, middle)
    return high
