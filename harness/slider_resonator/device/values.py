"""Checks of parameters and inputs that hold for every FMU with this interface."""

from __future__ import annotations

from math import inf, isfinite
from numbers import Real

from slider_resonator.device.interface import VARIABLES

LARGEST_INTEGER = 2**31 - 1
"""FMI 2.0 passes Integers as C ints, which would silently lose the upper bits of more."""


def check_value(name: str, value: float) -> None:
    """Raise ValueError, with name, value and requirement, unless the interface has such a value."""
    if not isinstance(value, Real):
        raise ValueError(f"{name} = {value!r}: must be a number")
    variable = VARIABLES[name]
    low = -inf if variable.minimum is None else variable.minimum
    high = inf if variable.maximum is None else variable.maximum
    if variable.kind == "Integer":
        check_integer(name, value)
        value = int(value)
    if not isfinite(value) or not low <= value <= high:
        raise ValueError(f"{name} = {value!r}: must be {variable.requirement}")


def check_integer(name: str, value: float) -> None:
    """Raise ValueError, with name, value and requirement, unless the value is an FMI Integer."""
    if not float(value).is_integer():
        raise ValueError(f"{name} = {value!r}: must be an integer")
    if abs(value) > LARGEST_INTEGER:
        raise ValueError(f"{name} = {value!r}: must be an integer up to {LARGEST_INTEGER}")
