"""The first zero of a smooth signal, by a search that cannot miss one.

From a point where the signal f is positive, f(t + d) >= f + f' d - B d^2 / 2 while B bounds |f''|.
The search advances by the zero of that parabola: it approaches the first zero from the left and
cannot step across it, nor across a pair of close zeros. Once f'^2 > 2 B f holds with f' < 0, the
next zero is simple and Newton's method converges to it (Kantorovich), so the search ends there.
"""

from collections.abc import Callable
from math import inf, sqrt
from typing import NamedTuple

Signal = Callable[[float], tuple[float, float, float]]
"""t [s] -> (f, f', bound of |f''| from t on up to the limit of the search)."""


class Watch(NamedTuple):
    """A signal whose first zero ends the mode, with the scales that its search needs.

    `noise` is the rounding error of its values, `fastest` [rad/s] its highest frequency.
    """

    signal: Signal
    noise: float
    fastest: float


SHORTEST = 1e-7
"""Shortest step of the search, as an angle [rad] of the highest frequency. Two zeros closer than
that enclose a dip within rounding, and count as a touch."""

SHORT = 0.01
"""Steps [rad] below this count as short. After each of them the shortest step grows a little, up to
this, which bounds the work on signals that stay within rounding of zero."""

RESOLUTION = 1e-16
"""Angle [rad] of the highest frequency to which zeros are located."""


def first_zero(watch: Watch, limit: float) -> float | None:
    """Time of the first downward zero in [0, limit) [s], or None, of a signal not negative at 0."""
    signal, noise, fastest = watch
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
                found = _newton(watch, t)
                return found if found < limit else None
            step = 2.0 * value / (root - slope)
        else:
            step = (slope + root) / bound if bound > 0.0 else inf
        if step * fastest < SHORT:
            shortest = min(1.035 * shortest, SHORT / fastest)
        before, t = t, t + max(step, shortest)
    return None


def _newton(watch: Watch, t: float) -> float:
    """The downward zero near `t` [s], by Newton's method, or infinity if none is found."""
    signal, noise, fastest = watch
    for _ in range(80):  # far more steps than a simple zero takes
        value, slope, bound = signal(t)
        if not slope < 0.0:
            break
        step = -value / slope
        t = max(0.0, t + step)
        # The next step would be below the resolution, or this one is rounding.
        if bound * step * step * fastest <= -slope * RESOLUTION or -noise <= value <= noise:
            return t
    return inf


def _bisected(watch: Watch, low: float, high: float) -> float:
    """Where the signal falls through -noise between `low` and `high` [s]."""
    while low < (middle := 0.5 * (low + high)) < high:
        low, high = (middle, high) if watch.signal(middle)[0] > -watch.noise else (low, middle)
    return high
