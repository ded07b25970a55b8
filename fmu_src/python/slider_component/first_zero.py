"""The first zero of a smooth signal, by a search that cannot miss one.

From a point where the signal f is positive, f(t + d) >= f + f' d - B d^2 / 2 while B bounds |f''|.
The search advances by the zero of that parabola: it approaches the first zero from the left and
cannot step across it, nor across a pair of close zeros. Once f'^2 > 2 B f holds with f' < 0, the
next zero is simple and Newton's method converges to it (Kantorovich), so the search ends there.

A zero that is expected at some time is looked for there at once. It is the first one if the
parabola from the start and that from the zero backwards leave no gap between them.
"""

from __future__ import annotations

from collections.abc import Callable
from math import sqrt
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


FLOOR_DOUBLING = 20
"""Short steps after which the shortest one doubles: bounds the work on signals that stay within
rounding of zero."""

SHORT_STEP = 0.01
"""How short these are, rad."""

MAX_SEARCH_EVALUATIONS = 1_000_000
"""Evaluations after which a search ends without a zero: reached only by motion at the limits of
floating point."""

MAX_NEWTON_STEPS = 60
MAX_EXPECTING_STEPS = 4

SURE = 0.99
"""Share of the interval that two parabolas cover that is relied on: a margin for rounding."""


def first_zero(
    watch: Watch, limit: float, start: float = 0.0, expected: float | None = None
) -> float | None:
    """Time of the first downward zero in [start, limit) [s], or None.

    The signal is non-negative at `start`. Two zeros closer than 1e-7 / fastest enclose a dip
    within rounding and count as a touch, which is no zero. A zero near `expected` [s] is found
    sooner.
    """
    signal, noise, fastest, horizon = watch
    t = start
    shortest = 1e-7 / fastest
    zero, steepness = None, 0.0
    if expected is not None and start < expected < limit:
        zero, steepness = _zero_near(signal, start, limit, expected, 1e-16 / fastest)
    evaluations = short_steps = 0
    while t < limit and evaluations < MAX_SEARCH_EVALUATIONS:
        value, slope, bound = signal(t)
        square = slope * slope
        evaluations += 1
        if slope < 0.0:
            if value <= noise:
                if value < -noise or square > 16.0 * noise * bound:
                    return t
                value = noise
            elif square > 2.2 * bound * (value + noise):
                root = _newton(signal, t, value, slope, fastest)
                return root if root < limit else None
            step = 2.0 * value / (sqrt(square + 2.0 * bound * value) - slope)
        else:
            value = value if value > noise else noise
            root_term = sqrt(square + 2.0 * bound * value)
            step = (slope + root_term) / bound if bound > 0.0 else horizon
        # The parabola from the zero backwards must cover the rest of the way, beyond rounding.
        if (
            zero is not None
            and 0.0 < zero - t < horizon
            and bound * (zero - t) < SURE * (bound * step - 2.0 * steepness)
            and steepness * steepness > 16.0 * noise * bound
        ):
            return zero
        if step * fastest < SHORT_STEP:
            short_steps += 1
            if short_steps % FLOOR_DOUBLING == 0:
                shortest *= 2.0
        if step < shortest:
            step = shortest
        t += horizon if step > horizon else step  # not a number stays so, and ends the search
    return None


def exceeds_noise(watch: Watch, t: float) -> bool:
    """Whether a watched signal exceeds its noise before `t` [s].

    In most cases its lower bound, a parabola, shows that without another evaluation.
    """
    value, slope, bound = watch.signal(0.0)
    ahead = t if t < watch.horizon else watch.horizon
    if 0.0 < slope < bound * ahead and value + 0.5 * slope * slope / bound > watch.noise:
        return True
    return watch.signal(0.5 * t)[0] > watch.noise


def _zero_near(
    signal: Signal, start: float, limit: float, t: float, resolution: float
) -> tuple[float | None, float]:
    """The downward zero near `t`, if Newton's method finds one in a few steps, and the slope there.

    None beyond `limit`, where the bound of the signal may not hold.
    """
    for _ in range(MAX_EXPECTING_STEPS):
        value, slope, bound = signal(t)
        if not slope < 0.0:
            break
        step = -value / slope
        t += step
        if not start < t < limit:
            break
        # The next step would be below the resolution.
        if bound * step * step <= -slope * resolution:
            return t, slope
    return None, 0.0


def _newton(signal: Signal, t: float, value: float, slope: float, fastest: float) -> float:
    """Newton's method from a point that satisfies Kantorovich's condition."""
    resolution = 1e-16 / fastest
    for _ in range(MAX_NEWTON_STEPS):
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
