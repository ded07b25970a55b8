"""The first sign change of a polynomial on an interval, isolated in Bernstein form.

The Bernstein coefficients of a polynomial on an interval change sign at least as often as the
polynomial does there, so an interval without such changes has no root and one with a single change
has exactly one. Halving the rest misses no pair of roots however close, down to rounding.
"""

from functools import cache
from math import comb

import numpy as np

from slider_resonator.arrays import Array


def first_fall(terms: Array, noise: float) -> float | None:
    """Return the first share in ``[0, 1]`` at which a polynomial turns negative, None if never.

    ``terms`` (shape (n + 1,)) are its coefficients, of ascending powers. What is smaller than
    ``noise``, the rounding error of the values, counts as zero, leading coefficients too: a
    polynomial may begin on a root, single or double, and is judged by what follows.
    """
    above_noise = np.abs(terms) > noise
    first = int(above_noise.argmax())
    if not above_noise[first]:
        return None
    deflated = terms[first:]
    if deflated[0] < 0.0:
        return 0.0
    to_bernstein, _ = _matrices(len(deflated) - 1)
    bernstein = to_bernstein @ deflated
    bracket = _first_bracket(bernstein, 0.0, 1.0, noise, 40)
    return None if bracket is None else _root(deflated[::-1].tolist(), *bracket)


@cache
def _matrices(degree: int) -> tuple[Array, Array]:
    """Return that to Bernstein form, and that of de Casteljau's algorithm for the first half."""
    sizes = range(degree + 1)
    binomials = np.array([[float(comb(row, column)) for column in sizes] for row in sizes])
    return binomials / binomials[-1], binomials / 2.0 ** np.arange(degree + 1.0)[:, None]


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
    _, halving = _matrices(len(bernstein) - 1)
    middle = 0.5 * (left + right)
    bracket = _first_bracket(halving @ bernstein, left, middle, noise, halvings - 1)
    if bracket is not None:
        return bracket
    second = halving[::-1, ::-1] @ bernstein
    return _first_bracket(second, middle, right, noise, halvings - 1)


def _root(descending: list[float], left: float, right: float) -> float:
    """Return the root between a positive left and a negative right end, by Newton's method.

    A step that leaves the bracket halves it instead.
    """
    share = 0.5 * (left + right)
    for _ in range(100):
        value = slope = 0.0
        for coefficient in descending:
            slope = slope * share + value
            value = value * share + coefficient
        if value > 0.0:
            left = share
        else:
            right = share
        before, share = share, share - value / slope if slope else left
        if not left <= share <= right:
            share = 0.5 * (left + right)
        if abs(share - before) <= 1e-12:  # the error is its square
            break
    return share
