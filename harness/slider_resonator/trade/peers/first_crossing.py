"""The first instant at which a smooth function turns negative, from values on a fine grid."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy.optimize import brentq

from slider_resonator.arrays import Array

Function = Callable[[float], tuple[float, float]]
"""Value and slope of a function of time."""

_HALVINGS = 60


def first_crossing(
    grid: Array,
    values: Array,
    slopes: Array,
    function: Function,
    floor: float,
) -> float | None:
    """Return the first time at which a function falls below zero, None if it does not.

    ``grid`` (shape (n,), ascending) must be so fine that the slope changes sign at most once in an
    interval; ``values`` and ``slopes`` are the function and its derivative there. Two roots in one
    interval are found through the minimum between them. Values above ``-floor`` count as zero,
    since an interval may begin on a root.
    """
    falls = values[1:] < -floor
    dips = (slopes[:-1] < 0.0) & (slopes[1:] > 0.0)
    for index in np.flatnonzero(falls | dips).tolist():
        left, right = float(grid[index]), float(grid[index + 1])
        if not falls[index]:
            right = _lowest(lambda time: function(time)[1], left, right)
            if not function(right)[0] < -floor:
                continue
        return _crossing_between(left, right, lambda time: function(time)[0])
    return None


def _crossing_between(left: float, right: float, value: Callable[[float], float]) -> float:
    if value(left) > 0.0:
        return _root(value, left, right)
    # The interval begins on a root: look for the positive interval behind it.
    width = right - left
    for _ in range(_HALVINGS):
        width *= 0.5
        if value(left + width) > 0.0:
            return _root(value, left + width, left + 2.0 * width)
    return left


def _lowest(slope: Callable[[float], float], left: float, right: float) -> float:
    """Return where a slope turns positive: at an end where its sign there is one of rounding."""
    if slope(left) >= 0.0:
        return left
    return right if slope(right) <= 0.0 else _root(slope, left, right)


def _root(value: Callable[[float], float], left: float, right: float) -> float:
    root: float = brentq(value, left, right, xtol=1e-16 * (right - left), rtol=1e-15)
    return root
