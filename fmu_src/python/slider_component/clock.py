"""Time within a step, summed without loss."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(slots=True)
class Clock:
    """Time `elapsed` [s] of a step of `duration` [s], with the rounding error of that sum."""

    duration: float
    elapsed: float = 0.0
    carry: float = 0.0

    def advance(self, t: float) -> float:
        """Advance by `t` [s] and return the time left [s]; two-sum keeps the rounding errors."""
        before = self.elapsed
        total = before + t
        carried = total - before
        self.carry += (before - (total - carried)) + (t - carried)
        self.elapsed = total
        return (self.duration - total) - self.carry
