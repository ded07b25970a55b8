"""The bounds of values, and what is raised for others."""

from math import isfinite
from typing import TypeGuard

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
    if (
        not is_finite_number(value)
        or (low is not None and value < low)
        or (high is not None and value > high)
        or (variable.type == "Integer" and value != int(value))
    ):
        raise Refusal(
            refusal_texts.OUT_OF_BOUNDS,
            name=variable.name,
            value=repr(value),
            requirement=variable.requirement,
        )
    return float(value) if variable.type == "Real" else int(value)


def is_finite_number(value: object) -> TypeGuard[int | float]:
    """Whether a value is a number that a float can hold; an int may be too large for one."""
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return False
    try:
        return isfinite(value)
    except OverflowError:
        return False
