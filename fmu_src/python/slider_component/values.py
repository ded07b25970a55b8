"""The bounds of values, and what is raised for others."""

from contextlib import suppress
from math import isfinite

from . import refusal_texts
from .variable import Variable
from .variables import VARIABLES

BY_NAME = {variable.name: variable for variable in VARIABLES}
SETTABLE = tuple(variable for variable in VARIABLES if variable.causality != "output")


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
    shown = {"name": variable.name, "value": repr(value), "requirement": variable.requirement}
    raise Refusal(refusal_texts.OUT_OF_BOUNDS, **shown)
