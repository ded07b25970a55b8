"""Checks of the values that a host sets."""

from __future__ import annotations

from math import isfinite

from .refusal import Refusal
from .variables import VARIABLES, Variable

BY_NAME = {variable.name: variable for variable in VARIABLES}
SETTABLE = tuple(variable for variable in VARIABLES if variable.causality != "output")


def checked(variable: Variable, value: object) -> float:
    """The value as the variable's type. Raises Refusal when it is not one that is allowed."""
    refused = Refusal(f"{variable.name} = {value!r} refused: allowed is {variable.allowed}")
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
    """A finite number of a stored state. Raises Refusal when it is none."""
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not isfinite(value):
        raise Refusal(f"FMU state refused: {name} = {value!r}; allowed is a finite number")
    return float(value)


def integer(name: str, value: object) -> int:
    """An integer of a stored state. Raises Refusal when it is none."""
    if isinstance(value, bool) or not isinstance(value, int):
        raise Refusal(f"FMU state refused: {name} = {value!r}; allowed is an integer")
    return value
