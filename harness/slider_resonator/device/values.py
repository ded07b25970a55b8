"""Values of parameters and inputs by name: what the interface allows, and text with a unit."""

from slider_resonator.device import units
from slider_resonator.device.interface import SETTABLE, VARIABLES
from slider_resonator.errors import unknown_name


def check_value(name: str, value: float) -> None:
    """Raise ValueError, with name, value and requirement, unless the interface has such a value."""
    VARIABLES[name].checked(value)


def settable_value(name: str, value: object) -> float:
    """Return a value of a parameter or input, a number or text, in its SI unit.

    Raises ValueError, with name, value and requirement, for one that the interface does not have.
    """
    if name not in SETTABLE:
        raise ValueError(unknown_name("parameter or input", name, SETTABLE))
    return float(VARIABLES[name].read(value))


def si_value(name: str, text: str) -> float:
    """Return the value of a parameter or input in its SI unit, as `units.si_number` does."""
    return VARIABLES[name].in_si(text)


def with_unit(name: str, value: float) -> str:
    """Return a value in the unit that engineers state it in: Hz, deg, um, g, mm/s, mN."""
    return units.with_unit(value, VARIABLES[name].unit)
