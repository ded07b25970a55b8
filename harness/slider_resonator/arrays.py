"""Arrays of numbers, whose docstrings say shape and unit, and numbers that differ by rounding."""

from math import isclose
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Number = TypeVar("Number", float, Array)
ROUNDING = 2.0**-50
"""Four units in the last place, as a share of a number."""
TINY = 1e-300
"""Numbers below this size count as 0."""


def is_same(first: float, second: float) -> bool:
    """Return whether two numbers are equal but for rounding; NaN is equal to nothing."""
    return isclose(first, second, rel_tol=ROUNDING, abs_tol=TINY)


def beyond_rounding(difference: Array, size: Array) -> Array:
    """Return differences, shape (n,), with 0 for each that is rounding of its size."""
    return np.where(difference <= ROUNDING * np.abs(size) + TINY, 0.0, difference)
