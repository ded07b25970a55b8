"""The work of one communication step."""

from dataclasses import dataclass
from math import floor, log10

from . import refusal_texts
from .constants import MAX_STEP_SEGMENTS, PYTHON_SLOWDOWN
from .values import Refusal

MAX_SEGMENTS = MAX_STEP_SEGMENTS // PYTHON_SLOWDOWN
"""Segments of motion in one communication step up to which its work is accepted."""


@dataclass(slots=True)
class Budget:
    """The work of a step of `step_size` [s] from a start [s] on: all its parts share a `limit`."""

    step_size: float
    start: float
    limit: int = MAX_SEGMENTS
    what: str = "segments of motion"
    spent: int = 0

    def spend(self, time: float) -> None:
        """Spend one more at a time [s]. Raises Refusal beyond the limit.

        A step up to that time takes less: the text names the power of ten below it.
        """
        reached = time - self.start
        self.spent += 1
        if self.spent > self.limit:
            work = {"step_size": self.step_size, "max_count": self.limit, "what": self.what}
            if reached > 0.0:
                exponent = floor(log10(reached))
                raise Refusal(refusal_texts.TOO_MUCH_WORK, exponent=exponent, **work)
            raise Refusal(refusal_texts.TOO_MUCH_WORK_AT_ONCE, **work)
