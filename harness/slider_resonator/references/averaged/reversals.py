"""Roots at which a periodic function changes sign, close pairs included."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy.optimize import brentq, minimize_scalar

from slider_resonator.arrays import Array

_GRID_PER_TURN = 256
_NEAR = 1e-3
"""Share of the greatest value below which a smallest value may hide a pair of roots."""


def sign_changes(function: Callable[[Array], Array], period: float) -> Array:
    """Return the ascending roots in [0, period) at which a function of that period changes sign.

    ``function`` takes and returns arrays of shape (n,); ``period`` is in rad. A pair of roots
    closer than the grid is found by the minimum between them.
    """

    def single(angle: float) -> float:
        return float(function(np.array([angle]))[0])

    grid = np.linspace(0.0, period, round(_GRID_PER_TURN * period / (2.0 * np.pi)) + 1)
    values = function(grid[:-1])
    values = np.append(values, values[0])
    brackets = [
        (grid[index], grid[index + 1])
        for index in np.flatnonzero((values[1:] > 0.0) != (values[:-1] > 0.0))
    ]
    size = np.abs(values[:-1])
    lowest = (size <= np.roll(size, 1)) & (size <= np.roll(size, -1)) & (size < _NEAR * size.max())
    width = grid[1]
    for index in np.flatnonzero(lowest).tolist():
        around = np.take(values[:-1], [index - 1, index, index + 1], mode="wrap") > 0.0
        if around.all() or not around.any():
            sign = 1.0 if around[0] else -1.0
            dip = minimize_scalar(
                lambda angle, sign=sign: sign * single(angle),
                bounds=(grid[index] - width, grid[index] + width),
                method="bounded",
                options={"xatol": 1e-9},
            )
            if dip.fun < 0.0:
                brackets += [(grid[index] - width, dip.x), (dip.x, grid[index] + width)]
    return np.unique([_root(single, *bracket) % period for bracket in brackets])


def _root(function: Callable[[float], float], left: float, right: float) -> float:
    at_left, at_right = function(left), function(right)
    if at_left * at_right >= 0.0:  # the sign on the grid was one of rounding
        return left if abs(at_left) < abs(at_right) else right
    return float(brentq(function, left, right, xtol=1e-15, rtol=8.9e-16))
