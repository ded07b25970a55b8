"""The work and the time of one communication step."""

from dataclasses import dataclass
from math import floor, log10

from . import refusal_texts
from .values import Refusal


@dataclass(slots=True)
class Budget:
    """The work of a step of `step_size` [s]; `spent` is the share of it that is spent.

    All parts of a step draw from one budget.
    """

    step_size: float
    spent: float = 0.0

    def left(self, max_count: int) -> int:
        """How much is left of a kind of work of which a whole budget buys `max_count`."""
        return int((1.0 - self.spent) * max_count) if self.spent < 1.0 else 0

    def spend(self, count: int, max_count: int) -> None:
        """Spend `count` of that work."""
        self.spent += count / max_count

    def refusal(self, reached: float, max_count: int, what: str) -> Refusal:
        """Return the refusal of work of which a whole budget buys `max_count` of `what`.

        A step up to `reached` [s] takes less: the text names the power of ten below it.
        """
        work = {"step_size": self.step_size, "max_count": max_count, "what": what}
        if reached > 0.0:
            exponent = floor(log10(reached))
            return Refusal(refusal_texts.TOO_MUCH_WORK, exponent=exponent, **work)
        return Refusal(refusal_texts.TOO_MUCH_WORK_AT_ONCE, **work)


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
