"""Numbers as text: with a unit or without, in SI units and as engineers state them."""

import re
from decimal import Decimal
from functools import cache
from math import inf, isclose, isfinite
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import pint

_UNIT = r"[A-Za-zµμ°%]+(?:(?:\^|\*\*)-?\d)?"
_TEXT = re.compile(
    rf"\s*(?P<number>[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)"
    rf"\s*(?P<unit>(?:1\s*/\s*)?{_UNIT}(?:\s*[*/]\s*{_UNIT})*)\s*"
)
"""A number with a unit: what the library evaluates is no more than that."""
SHOWN = {"rad/s": "Hz", "rad": "deg"}
"""For an SI unit, the one in which engineers state such a value."""
_EXAMPLES = {"rad/s": "20 kHz", "rad": "30 deg", "1": "2 %", "kg": "5 g", "m": "1 um", "N": "1 mN"}


@cache
def registry() -> "pint.UnitRegistry[Any]":
    """Return the units, in which a frequency in Hz is an angular one."""
    import pint  # takes half a second: only where a text is read or shown

    units: pint.UnitRegistry[Any] = pint.UnitRegistry()
    # A frequency in Hz counts periods; those of the interface are angular.
    units.define("hertz = 2 * pi * radian / second = Hz")
    return units


def is_number(text: str) -> bool:
    """Whether a text is a finite number, without a unit."""
    try:
        return isfinite(float(text))
    except ValueError:
        return False


def finite_number(name: str, text: str | None) -> float:
    """Return the number that a text is; ValueError with name and text for any other text."""
    if text is None or not is_number(text):
        raise ValueError(f"{name} = {text!r}: must be a finite number")
    return float(text)


def si_number(name: str, text: str, unit: str) -> float:
    """Return the number in an SI unit of a text with a unit, or of one that is a number.

    Hz, kHz and rpm give rad/s. Raises ValueError with name, text and what it must be.
    """
    try:
        return float(text)
    except ValueError:
        match = _TEXT.fullmatch(text)
    number = "number" if unit == "1" else f"number in {unit}"
    must = f"must be a {number}, or a text with a unit such as {_EXAMPLES.get(unit, f'5 {unit}')!r}"
    if match is None:
        raise ValueError(f"{name} = {text!r}: {must}")
    if match["unit"] == "gr":  # to the library grains, not grams
        raise ValueError(f"{name} = {text!r}: unknown unit 'gr'; {must}")
    import pint

    try:
        scale = registry().Quantity(1.0, match["unit"].replace(" ", ""))
        factor = float(scale.to("dimensionless" if unit == "1" else unit).magnitude)
    except pint.UndefinedUnitError as error:
        raise ValueError(f"{name} = {text!r}: unknown unit {match['unit']!r}; {must}") from error
    except (pint.PintError, ArithmeticError, AssertionError, TypeError, ValueError) as error:
        raise ValueError(f"{name} = {text!r}: not in {unit}; {must}") from error
    if unit == "rad" and factor >= 1e3:
        raise ValueError(f"{name} = {text!r}: {match['unit']} is {factor:g} rad; {must}")
    return scaled(float(match["number"]), factor)


def scaled(number: float, factor: float) -> float:
    """Return a number of a unit in the SI unit, so that 30.1 mN are 0.0301 N to the last bit."""
    parts = round(1.0 / factor)
    is_part = isclose(parts * factor, 1.0, rel_tol=1e-12)
    return float(Decimal(repr(number)) / parts) if is_part else number * factor


def positive_time(text: str) -> float:
    """Return a time in s above 0; ValueError for another text."""
    seconds = si_number("time", text, "s")
    if not 0.0 < seconds < inf:
        raise ValueError(f"time = {text!r}: must be above 0 s, and finite")
    return seconds
