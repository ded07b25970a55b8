"""Angles and elapsed times that do not lose digits over many additions."""

import math
from dataclasses import dataclass

from slider_resonator.arrays import Number

_TURN = 2.0 * math.pi
_TURN_REMAINDER = 2.4492935982947064e-16  # 2 pi minus its double precision value


def advanced(angle: float, increment: float) -> float:
    """Return ``angle + increment`` (rad) reduced to within half a turn of zero."""
    total = angle + increment
    turns = round(total / _TURN)
    return total - turns * _TURN - turns * _TURN_REMAINDER


@dataclass
class Elapsed:
    """A running sum of time steps (s) that keeps its rounding error."""

    seconds: float = 0.0
    carry: float = 0.0

    @property
    def total(self) -> float:
        """The sum (s), rounded."""
        return self.seconds + self.carry

    def until(self, time: Number) -> Number:
        """Return how far a time, or an array of times, lies ahead (s)."""
        return (time - self.seconds) - self.carry

    def add(self, step: float) -> None:
        """Add a step of at least 0 s."""
        increment = step + self.carry
        total = self.seconds + increment
        self.carry = increment - (total - self.seconds)
        self.seconds = total
