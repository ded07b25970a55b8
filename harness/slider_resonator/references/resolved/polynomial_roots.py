"""The first sign change of a polynomial on an interval, isolated in Bernstein form.

The Bernstein coefficients of a polynomial on an interval change sign at least as often as the
polynomial does there, so an interval without such changes has no root and one with a single change
has exactly one. Halving the rest misses no pair of roots however close, down to rounding.
"""

from __future__ import annotations

from functools import cache
from math import comb

import numpy as np
from scipy.optimize import brentq

from slider_resonator.arrays import Array

_HALVINGS = 40


def first_fall(coefficients: Array, stop: float, noise: float) -> float | None:
    """Return the first time in ``[0, stop]`` at which a polynomial turns negative, None if never.

    ``coefficients`` (shape (n + 1,)) belong to ascending powers of time. What is smaller than
    ``noise``, the rounding error of the values, counts as zero, leading coefficients too: a
    polynomial may begin on a root, single or double, and is judged by what follows.
    """
    scaled = coefficients * stop ** np.arange(len(coefficients))
    above_noise = np.flatnonzero(np.abs(scaled) > noise)
    if not above_noise.size:
        return None
    deflated = scaled[above_noise[0] :]
    if deflated[0] < 0.0:
        return 0.0
    bernstein = _to_bernstein(len(deflated) - 1) @ deflated
    bracket = _first_bracket(bernstein, 0.0, 1.0, noise, _HALVINGS)
    if bracket is None:
        return None
    descending = deflated[::-1].tolist()
    root: float = brentq(_horner, *bracket, args=(descending,), xtol=1e-18, rtol=1e-15)
    return root * stop


@cache
def _to_bernstein(degree: int) -> Array:
    return np.array(
        [
            [comb(row, column) / comb(degree, column) for column in range(degree + 1)]
            for row in range(degree + 1)
        ]
    )


def _first_bracket(
    bernstein: Array, left: float, right: float, noise: float, halvings: int
) -> tuple[float, float] | None:
    """Return an interval with one fall of a polynomial that is positive at its left end."""
    signs = np.sign(bernstein[np.abs(bernstein) > noise])
    changes = int(np.count_nonzero(signs[1:] != signs[:-1]))
    if changes == 0 or halvings == 0:
        return None
    if changes == 1 and bernstein[0] > 0.0 > bernstein[-1]:
        return left, right
    first, second = _halved(bernstein)
    middle = 0.5 * (left + right)
    bracket = _first_bracket(first, left, middle, noise, halvings - 1)
    return bracket or _first_bracket(second, middle, right, noise, halvings - 1)


def _halved(bernstein: Array) -> tuple[Array, Array]:
    """Split by de Casteljau's algorithm; both halves hold the same polynomial."""
    row = bernstein
    first, second = [row[0]], [row[-1]]
    while len(row) > 1:
        row = 0.5 * (row[1:] + row[:-1])
        first.append(row[0])
        second.append(row[-1])
    return np.array(first), np.array(second[::-1])


def _horner(time: float, descending: list[float]) -> float:
    value = 0.0
    for coefficient in descending:
        value = value * time + coefficient
    return value
