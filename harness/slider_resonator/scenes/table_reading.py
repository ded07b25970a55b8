"""Read the content of a file as a table of a schema: units, and errors with key and requirement."""

import re
from collections.abc import Mapping
from datetime import date, time
from typing import Any, TypeVar, get_args

from pydantic import BaseModel, ValidationError
from pydantic.fields import FieldInfo
from pydantic_core import ErrorDetails

from slider_resonator.device.device import DEVIATIONS
from slider_resonator.device.interface import INPUTS, OUTPUTS, PARAMETERS, TUNABLES, VARIABLES
from slider_resonator.device.units import si_number
from slider_resonator.errors import SceneError, explained, unknown_name
from slider_resonator.scenes.expansion import with_bundles
from slider_resonator.scenes.key_table import HAS_UNIT, units_of
from slider_resonator.scenes.needs import NeedTable
from slider_resonator.scenes.schema import DeviceFileTable, RunTable, SceneTable
from slider_resonator.scenes.toml_file import toml_value
from slider_resonator.scenes.vocabulary import QUANTITIES

TableT = TypeVar("TableT", bound=BaseModel)


def table_from(table: type[TableT], content: Mapping[str, Any], source: str) -> TableT:
    """Return the content of a file as a table of a schema, texts with units in SI units.

    Raises SceneError with a line for each mistake: `source`, key path, value and requirement. Of
    the mistakes of one kind in a list only the first is reported.
    """
    with explained(f"{source}: "):
        content = _in_si(content)
    try:
        return table.model_validate(content)
    except ValidationError as error:
        first: dict[tuple[object, ...], ErrorDetails] = {}
        for problem in error.errors():
            place = problem["loc"]
            in_list = bool(place) and isinstance(place[-1], int)
            first.setdefault((problem["type"], *(place[:-1] if in_list else place)), problem)
        lines = [f"{source}: {_explanation(one, content, table)}" for one in first.values()]
        raise SceneError("\n".join(lines)) from None


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


def _in_si(value: Any, path: str = "", unit: str = "") -> Any:
    """Return the content of a file, with numbers in SI units for its texts with a unit.

    `unit` is that of the values at a path, empty for what has none. What is no such text stays as
    it is, for the schema to refuse. Raises ValueError with key, value and requirement.
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
            key: _in_si(one, f"{path}.{key}".lstrip("."), units.get(key, ""))
            for key, one in value.items()
        }
    if not isinstance(value, list | tuple):
        return value
    first = "s" if _POINT.search(path) else unit
    return [
        _in_si(one, f"{path}[{k + 1}]", unit if k else first)
        if isinstance(one, str | Mapping | list | tuple)
        else one
        for k, one in enumerate(value)
    ]


_REQUIREMENTS: Mapping[str, str] = {
    "dict_type": "a table of keys and values",
    "bool_type": "true or false",
    "finite_number": "a finite number",
    "float_type": "a number",
    "greater_than": "a number above {gt:g}",
    "greater_than_equal": "a number not below {ge:g}",
    "int_type": "a whole number",
    "less_than": "a number below {lt:g}",
    "less_than_equal": "a number up to {le:g}",
    "literal_error": "{expected}",
    "model_type": "a table of keys and values",
    "string_too_short": "a text that is not empty",
    "string_pattern_mismatch": "a word of letters, digits, _ and -",
    "string_type": "a text in quotes",
    "too_long": "a list of {max_length} numbers",
    "too_short": "a list of at least {min_length} number",
    "tuple_type": "a list in brackets",
}
"""What a value must be, by the type of error that pydantic finds."""


_NO_UNITS = ("1", "unit of the quantity")


PLACES: Mapping[str, str] = {
    **dict.fromkeys(OUTPUTS, "an output cannot be set"),
    **dict.fromkeys(PARAMETERS, "a parameter must be in [device]"),
    **dict.fromkeys(TUNABLES, "a tunable parameter must be in [device] or in [tuning]"),
    **dict.fromkeys((*INPUTS, *DEVIATIONS), "an input must be given by --set, or in [inputs]"),
    **dict.fromkeys(RunTable.model_fields, "must be in [run]"),
    **dict.fromkeys(SceneTable.model_fields, "must be above the first heading"),
}
"""The table to which a key belongs that was found in another table."""


AXIS = ("<values>", "<range>")
"""Tags of the two forms of an axis of a grid; like that of a constant input they are no keys."""


def _explanation(problem: ErrorDetails, content: Mapping[str, Any], top: type[BaseModel]) -> str:
    """Return key path, value and requirement of an error."""
    location = tuple(part for part in problem["loc"] if part not in ("constant", *AXIS))
    kind, value = problem["type"], problem["input"]
    wrong = problem["msg"].removeprefix("Value error, ")
    if not location:
        return wrong
    if kind == "missing" and isinstance(location[-1], int):
        location = location[:-1]  # a pair of one number
    name, key = location[-1], _key_path(location, content)
    if wrong.startswith(f"{name} = "):
        return key.removesuffix(str(name)) + wrong
    if kind == "extra_forbidden":
        if name in PLACES and top in (SceneTable, DeviceFileTable):
            return f"{key}: unknown key {name!r}; {PLACES[str(name)]}"
        return f"{key}: {unknown_name('key', str(name), map(str, _fields_at(location, top)))}"
    if len(location) > 1 and location[-2] in ("steps", "ramp"):
        wrong, kind = "must be a pair [time (s), value]", ""
    field = _fields_at(location, top).get(name)
    if kind == "missing":
        if field and _tables_in(field.annotation):
            return f"{key}: is missing; add a table, headed [{key}]"
        examples = field.examples if field else None
        example = f"; add {name} = {toml_value(examples[0])}" if examples else ""
        return f"{key}: is missing{example}"
    if kind in _REQUIREMENTS:
        wrong = "must be " + _REQUIREMENTS[kind].format(**problem.get("ctx", {}))
        about = field.json_schema_extra if field else None
        unit = str(about.get("unit", "1")) if isinstance(about, dict) else "1"
        wrong += f", in {unit}" if "number" in wrong and unit not in _NO_UNITS else ""
    if location == ("expect",):
        wrong = "must be a list of tables, each headed [[expect]]"
    elif kind == "model_type" and isinstance(value, list):
        wrong = f"must be one table, headed [{key}]"
    if problem["loc"][-1] == "constant" and str(value).lower().endswith(".csv"):
        wrong = f"must be a number, or a file such as {{ csv = {toml_value(value)} }}"
    elif problem["loc"][-1] == "constant" and isinstance(value, list):
        wrong = "must be a number, or values over time such as { steps = [[0, 0], [0.05, 0.04]] }"
    text = str(value) if isinstance(value, date | time) else repr(value)
    shown = "" if isinstance(value, dict) else f" = {text}"
    return f"{key}{shown}: {wrong}"


def _key_path(location: tuple[int | str, ...], content: Mapping[str, Any]) -> str:
    """Return the path of a key; an expectation goes by quantity and reference, if it has any."""
    parts = [f"[{part + 1}]" if isinstance(part, int) else f".{part}" for part in location]
    if len(location) > 1 and location[0] == "expect" and isinstance(location[1], int):
        expect = with_bundles(content)["expect"][location[1]]
        known = [str(expect[key]) for key in ("quantity", "reference") if key in expect]
        parts[1] = f"[{', '.join(known)}]" if known else parts[1]
    return "".join(parts).lstrip(".")


def _fields_at(location: tuple[int | str, ...], top: type[BaseModel]) -> dict[int | str, FieldInfo]:
    """Return the fields, by key, of the table that has the last key of a location."""
    model = top
    for part in location[:-1]:
        if part in model.model_fields:
            tables = _tables_in(model.model_fields[str(part)].annotation)
            if not tables:
                return {}  # below a mapping of names, such as [fixed] of a grid
            model = tables[-1]
    return {field.alias or name: field for name, field in model.model_fields.items()}


def _tables_in(annotation: Any) -> list[type[BaseModel]]:
    """Return the tables inside an annotation such as `RunTable | None`."""
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return [annotation]
    return [table for part in get_args(annotation) for table in _tables_in(part)]
