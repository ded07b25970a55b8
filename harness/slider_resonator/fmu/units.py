"""Checking the unit definitions of an FMU against the names of the units."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from math import isclose, pi

from fmpy.model_description import BaseUnit, DisplayUnit, Unit

DIMENSIONS: Mapping[str, Mapping[str, int]] = {
    "1": {},
    "rad": {},
    "rad/s": {"s": -1},
    "kg": {"kg": 1},
    "m": {"m": 1},
    "m/s": {"m": 1, "s": -1},
    "s": {"s": 1},
    "N": {"kg": 1, "m": 1, "s": -2},
    "1/m": {"m": -1},
    "s/m": {"s": 1, "m": -1},
}
"""Unit of the interface to its exponents of SI base units; to the SI a radian is 1."""

_EXPONENTS = ("kg", "m", "s", "A", "K", "mol", "cd")
_PREFIXES = {"n": 1e9, "u": 1e6, "µ": 1e6, "m": 1e3, "c": 1e2, "d": 1e1, "k": 1e-3, "M": 1e-6}
_DISPLAYED: Mapping[str, Mapping[str, float]] = {
    "1": {"%": 100.0, "ppm": 1e6},
    "rad": {"deg": 180.0 / pi, "°": 180.0 / pi},
    "rad/s": {"Hz": 0.5 / pi, "kHz": 0.5e-3 / pi, "deg/s": 180.0 / pi, "rpm": 30.0 / pi},
    "kg": {"g": 1e3, "mg": 1e6, "t": 1e-3},
}
"""Unit to names that it may be displayed in, with the factor; prefixes come on top of these."""
_ROUNDED = 1e-5
"""Tolerated relative error of a display factor, which may have been rounded."""


def unit_problems(unit: str, definitions: Sequence[Unit]) -> list[str]:
    """Return the errors in the definition of a unit of the interface; none without a definition.

    Its base unit must have the exponents that the name stands for, factor 1 and offset 0, because
    the values of variables are taken as they are; display units must have the factor that goes
    with their names, as far as these are known. The exponent of rad is free.
    """
    problems: list[str] = []
    for definition in definitions:
        if definition.name == unit:
            problems += _base_problems(unit, definition.baseUnit)
            problems += _display_problems(unit, definition.displayUnits)
    return problems


def _base_problems(unit: str, base: BaseUnit | None) -> Iterator[str]:
    if base is None:
        return
    expected = DIMENSIONS[unit]
    found = {name: getattr(base, name) for name in _EXPONENTS if getattr(base, name)}
    if found != dict(expected):
        yield f"unit {unit} is defined as {_dimension(found)}, must be {_dimension(expected)}"
    if base.factor != 1.0:
        yield f"unit {unit} is defined with factor {base.factor!r}, must be 1"
    if base.offset != 0.0:
        yield f"unit {unit} is defined with offset {base.offset!r}, must be 0"


def _display_problems(unit: str, displayed: Sequence[DisplayUnit]) -> Iterator[str]:
    for display in displayed:
        factor = _factor(unit, str(display.name))
        if factor is None:
            continue
        where = f"display unit {display.name} of unit {unit} is defined with"
        if not isclose(display.factor, factor, rel_tol=_ROUNDED):
            yield f"{where} factor {display.factor!r}, must be {factor:.9g}"
        if display.offset != 0.0:
            yield f"{where} offset {display.offset!r}, must be 0"


def _factor(unit: str, display: str) -> float | None:
    """Return the factor from `unit` to a display unit, None for unknown names."""
    if display == unit:
        return 1.0
    named = _DISPLAYED.get(unit, {})
    if display in named:
        return named[display]
    if unit in ("m", "m/s", "s", "N") and display[1:] == unit:
        return _PREFIXES.get(display[0])
    return None


def _dimension(exponents: Mapping[str, int]) -> str:
    """Return exponents as text, such as "kg m s^-2"."""
    parts = [name if power == 1 else f"{name}^{power}" for name, power in exponents.items()]
    return " ".join(parts) or "1"
