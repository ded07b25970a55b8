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
    """The work of a step of `step_size` [s]: all its parts spend from the same `limit`."""

    step_size: float
    limit: int = MAX_SEGMENTS
    what: str = "segments of motion"
    spent: int = 0

    def spend(self, reached: float) -> None:
        """Spend one more. Raises Refusal beyond the limit; a step up to `reached` [s] takes less.

        The text names the power of ten below it.
        """
        self.spent += 1
        if self.spent > self.limit:
            work = {"step_size": self.step_size, "max_count": self.limit, "what": self.what}
            if reached > 0.0:
                exponent = floor(log10(reached))
                raise Refusal(refusal_texts.TOO_MUCH_WORK, exponent=exponent, **work)
            raise Refusal(refusal_texts.TOO_MUCH_WORK_AT_ONCE, **work)
