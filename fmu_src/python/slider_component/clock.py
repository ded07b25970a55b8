"""Time within a step, summed without loss."""

from __future__ import annotations


class Clock:
    """Time `elapsed` [s] of a step of `duration` [s], with the rounding error of that sum."""

    __slots__ = ("_carry", "_duration", "elapsed")

    def __init__(self, duration: float) -> None:
        self._duration = duration
        self.elapsed = self._carry = 0.0

    def advance(self, t: float) -> float:
        """Advance by `t` [s] and return the time left [s]; two-sum keeps the rounding errors."""
        before = self.elapsed
        total = before + t
        carried = total - before
        self._carry += (before - (total - carried)) + (t - carried)
        self.elapsed = total
        return (self._duration - total) - self._carry
