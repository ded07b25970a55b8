"""Texts with a unit in scene, grid and device files, as numbers in SI units."""

import re
from collections.abc import Mapping
from typing import Any

from slider_resonator.device.interface import VARIABLES
from slider_resonator.device.units import si_number
from slider_resonator.scenes.key_table import HAS_UNIT, units_of
from slider_resonator.scenes.schema import NeedTable, RunTable
from slider_resonator.scenes.vocabulary import QUANTITIES

_UNITS: Mapping[str, str] = {
    **{name: v.unit for name, v in VARIABLES.items() if v.kind == "Real"},
    **{name: unit for name, unit in units_of(RunTable).items() if unit == "s"},
    **units_of(NeedTable),
    **dict.fromkeys(("rel", "relative"), "1"),
}
"""Keys of values, or of tables of values, and their units."""
_INHERITED = (
    *("constant", "steps", "ramp", "from", "to", "values"),
    *("abs", "absolute", "value", "at_most", "at_least"),
)
"""Keys of values whose unit is that of the table they are in."""
_NEED = re.compile(r"need\.\w+")
"""The path of a needed quantity."""
_POINT = re.compile(r"\.(steps|ramp)\[\d+\]$")
"""The end of the path of a pair [time, value]."""


def in_si(value: Any, path: str = "", unit: str = "") -> Any:
    """Return the content of a file, with numbers in SI units for its texts with a unit.

    `unit` is that of the values at a path, empty for what has none. What is no such text stays as
    it is, for the schema to refuse. Raises ValueError with key, value and requirement for a unit
    that does not fit.
    """
    if path.endswith("device"):
        return value  # its schema reads units
    if isinstance(value, str):
        if _NEED.fullmatch(path):
            return value  # it must be a table
        is_number = unit and re.search(HAS_UNIT, value) and not value.lower().endswith(".csv")
        return si_number(path, value, unit) if is_number else value
    if isinstance(value, Mapping):
        about = QUANTITIES.get(str(value.get("quantity")))
        own = about.unit if about else _UNITS.get(str(value.get("variable")), "")
        own = own if own in _UNITS.values() else unit
        units = {**dict.fromkeys(_INHERITED, own), **_UNITS}
        return {
            key: in_si(one, f"{path}.{key}".lstrip("."), units.get(key, ""))
            for key, one in value.items()
        }
    if not isinstance(value, list | tuple):
        return value
    first = "s" if _POINT.search(path) else unit
    return [
        in_si(one, f"{path}[{k + 1}]", unit if k else first)
        if isinstance(one, str | Mapping | list | tuple)
        else one
        for k, one in enumerate(value)
    ]
