"""Checks of values that a host sets, and of numbers in a stored state."""

from __future__ import annotations

from math import isfinite

from . import refusal_texts
from .refusal import Refusal
from .variable import Variable
from .variables import VARIABLES

BY_NAME = {variable.name: variable for variable in VARIABLES}
SETTABLE = tuple(variable for variable in VARIABLES if variable.causality != "output")


def checked(variable: Variable, value: object) -> float:
    """Return the value in the variable's type. Raises Refusal for one that the table excludes."""
    refused = Refusal(refusal_texts.out_of_bounds(variable.name, value, variable.requirement))
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not isfinite(value):
        raise refused
    low, high = variable.minimum, variable.maximum
    if (low is not None and value < low) or (high is not None and value > high):
        raise refused
    if variable.type == "Real":
        return float(value)
    if value != int(value):
        raise refused
    return int(value)


def number(name: str, value: object) -> float:
    """Return a finite number of a stored state. Raises Refusal for anything else."""
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not isfinite(value):
        raise Refusal(refusal_texts.infinite_in_state(name, value))
    return float(value)


def integer(name: str, value: object) -> int:
    """Return an integer of a stored state. Raises Refusal for anything else."""
    if isinstance(value, bool) or not isinstance(value, int):
        raise Refusal(f"FMU state refused: {name} = {value!r}; must be an integer")
    return value
