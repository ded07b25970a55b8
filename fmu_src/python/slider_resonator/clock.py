"""Time within a step, summed without loss."""

from __future__ import annotations


class Clock:
    """What is left of a step of `duration` [s], after any number of advances."""

    __slots__ = ("_carry", "_duration", "_elapsed")

    def __init__(self, duration: float) -> None:
        self._duration = duration
        self._elapsed = self._carry = 0.0

    def advance(self, t: float) -> float:
        """Count `t` [s] and return what is left [s]; two-sum keeps the rounding."""
        before = self._elapsed
        total = before + t
        carried = total - before
        self._carry += (before - (total - carried)) + (t - carried)
        self._elapsed = total
        return (self._duration - total) - self._carry
