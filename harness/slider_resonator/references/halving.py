"""The root of a monotonic function by halving: scipy's takes longer to load than many answers."""

from __future__ import annotations

from collections.abc import Callable


def root_by_halving(function: Callable[[float], float], left: float, right: float) -> float:
    """Return where a function that rises or falls from `left` to `right` is 0, to rounding."""
    falls = function(left) > 0.0
    while True:
        middle = 0.5 * (left + right)
        if middle in (left, right):
            return middle
        if (function(middle) > 0.0) == falls:
            left = middle
        else:
            right = middle
