"""Differences that rounding explains: nothing may depend on bits that nobody needs."""

from math import isclose

import numpy as np
from numpy.typing import NDArray

ROUNDING = 2.0**-50
"""Four units in the last place, as a share of a number."""
TINY = 1e-300
"""Numbers below this size count as 0."""


def is_same(first: float, second: float) -> bool:
    """Return whether two numbers are equal but for rounding; NaN is equal to nothing."""
    return isclose(first, second, rel_tol=ROUNDING, abs_tol=TINY)


def beyond_rounding(
    difference: NDArray[np.float64], size: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return differences, shape (n,), with 0 for each that is rounding of its size."""
    return np.where(difference <= ROUNDING * np.abs(size) + TINY, 0.0, difference)
