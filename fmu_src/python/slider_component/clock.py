"""Time within a step, summed without loss."""

from __future__ import annotations


class Clock:
    """What has `elapsed` [s] and what is left of a step of `duration` [s]."""

    __slots__ = ("_carry", "_duration", "elapsed")

    def __init__(self, duration: float) -> None:
        self._duration = duration
        self.elapsed = self._carry = 0.0

    def advance(self, t: float) -> float:
        """Count `t` [s] and return what is left [s]; two-sum keeps the rounding."""
        before = self.elapsed
        total = before + t
        carried = total - before
        self._carry += (before - (total - carried)) + (t - carried)
        self.elapsed = total
        return (self._duration - total) - self._carry
