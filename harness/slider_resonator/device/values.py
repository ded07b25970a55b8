"""Checks of parameters and inputs that hold for every FMU with this interface."""

from __future__ import annotations

from math import isfinite

from slider_resonator.device.interface import INTEGERS

LARGEST_INTEGER = 2**31 - 1
"""FMI 2.0 passes Integers as C ints, which would silently lose the upper bits of more."""


POSITIVE = frozenset({"slider_mass", "resonator_frequency", "drive_frequency"})
"""Parameters that the harness itself divides by, for instance to count drive periods."""
NOT_NEGATIVE = frozenset({"resonator_mass", "normal_preload"})
"""Parameters whose sums and roots it takes before an FMU sees them."""


def check_value(name: str, value: float) -> None:
    """Raise ValueError, with name, value and requirement; other ranges are left to the FMU."""
    if name in INTEGERS:
        check_integer(name, value)
    elif not isfinite(value):
        raise ValueError(f"{name} = {value!r}: must be a finite number")
    elif name in NOT_NEGATIVE and value < 0.0:
        raise ValueError(f"{name} = {value!r}: must be a number from 0 on")
    elif name in POSITIVE and not value > 0.0:
        raise ValueError(f"{name} = {value!r}: must be a number above 0")


def check_integer(name: str, value: float) -> None:
    """Raise ValueError, with name, value and requirement, unless the value is an FMI Integer."""
    if not float(value).is_integer():
        raise ValueError(f"{name} = {value!r}: must be an integer")
    if abs(value) > LARGEST_INTEGER:
        raise ValueError(f"{name} = {value!r}: must be an integer up to {LARGEST_INTEGER}")
