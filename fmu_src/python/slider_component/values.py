"""What a call must respect: the states of FMI, and the bounds of values."""

from __future__ import annotations

from enum import StrEnum
from math import isfinite, tau
from typing import TypeGuard

from . import refusal_texts
from .variable import Variable
from .variables import VARIABLES

BY_NAME = {variable.name: variable for variable in VARIABLES}
SETTABLE = tuple(variable for variable in VARIABLES if variable.causality != "output")


class Refusal(ValueError):
    """A refused call. The component is as it was before the call."""


class Lifecycle(StrEnum):
    """State of an instance, by FMI's names."""

    INSTANTIATED = "instantiated"
    INITIALIZATION = "initialization mode"
    STEP_COMPLETE = "step complete"
    TERMINATED = "terminated"


def require(call: str, state: Lifecycle, required: Lifecycle) -> None:
    """Raise Refusal for a call in any state but `required`."""
    if state != required:
        raise Refusal(refusal_texts.wrong_state(call, state, required))


def checked(variable: Variable, value: object) -> float:
    """Return the value in the variable's type. Raises Refusal for one that the table excludes."""
    refused = Refusal(refusal_texts.out_of_bounds(variable.name, value, variable.requirement))
    if not _is_finite_number(value):
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
    if not _is_finite_number(value):
        raise Refusal(refusal_texts.infinite_in_state(name, value))
    return float(value)


def phase(name: str, value: object) -> float:
    """Return a phase [rad] of a stored state within a turn. Raises Refusal for anything else."""
    angle = number(name, value)
    if not 0.0 <= angle <= tau:  # a turn where rounding takes a phase below 0 up to it
        raise Refusal(refusal_texts.phase_in_state(name, value))
    return angle


def integer(name: str, value: object) -> int:
    """Return an integer of a stored state that is also a finite float. Raises Refusal if not."""
    if not _is_finite_number(value) or not isinstance(value, int):
        raise Refusal(f"FMU state refused: {name} = {value!r}; must be an integer")
    return value


def integer_within(name: str, value: object, minimum: int, maximum: int) -> int:
    """Return an integer of a stored state from a range. Raises Refusal for anything else."""
    if isinstance(value, bool) or not isinstance(value, int) or not minimum <= value <= maximum:
        raise Refusal(refusal_texts.out_of_range_in_state(name, value, minimum, maximum))
    return value


def flag(name: str, value: object) -> bool:
    """Return true or false of a stored state. Raises Refusal for anything else."""
    if not isinstance(value, bool):
        raise Refusal(f"FMU state refused: {name} = {value!r}; must be true or false")
    return value


def _is_finite_number(value: object) -> TypeGuard[int | float]:
    """Whether a value is a number that a float can hold; an int may be too large for one."""
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return False
    try:
        return isfinite(value)
    except OverflowError:
        return False
