"""The bounds of values and of the work of a step, and what is raised beyond them."""

from contextlib import suppress
from dataclasses import dataclass
from math import floor, isfinite, log10

from . import refusal_texts as texts
from .constants import MAX_STEP_SEGMENTS, PYTHON_SLOWDOWN
from .variable import Variable
from .variables import VARIABLES

BY_NAME = {variable.name: variable for variable in VARIABLES}
SETTABLE = tuple(variable for variable in VARIABLES if variable.causality != "output")

MAX_SEGMENTS = MAX_STEP_SEGMENTS // PYTHON_SLOWDOWN
"""Segments of motion in one communication step up to which its work is accepted."""


class Refusal(Exception):
    """A refused call. The component is as it was before the call."""

    def __init__(self, text: str, **arguments: object) -> None:
        """By a text with the names of its arguments in braces."""
        super().__init__(text.format(**arguments))


def checked(variable: Variable, value: object) -> float:
    """Return the value in the variable's type. Raises Refusal for one that the table excludes."""
    low, high = variable.minimum, variable.maximum
    with suppress(OverflowError):  # an int may be too large for a float
        if (
            isinstance(value, (int, float))
            and not isinstance(value, bool)
            and isfinite(value)
            and (low is None or value >= low)
            and (high is None or value <= high)
            and (variable.type == "Real" or value == int(value))
        ):
            return float(value) if variable.type == "Real" else int(value)
    bounds = variable.requirement
    raise Refusal(texts.OUT_OF_BOUNDS, name=variable.name, value=repr(value), requirement=bounds)


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
        self.spent += 1
        if self.spent > self.limit:
            work = {"step_size": self.step_size, "max_count": self.limit, "what": self.what}
            if time > self.start:
                raise Refusal(texts.TOO_MUCH_WORK, exponent=floor(log10(time - self.start)), **work)
            raise Refusal(texts.TOO_MUCH_WORK_AT_ONCE, **work)
