"""Explain the errors of a scene or grid file: file, key, value and requirement."""

from collections.abc import Mapping
from datetime import date, time
from typing import Any, get_args

from pydantic import BaseModel, ValidationError
from pydantic_core import ErrorDetails

from slider_resonator.device.device import DEVIATIONS
from slider_resonator.device.interface import (
    INPUTS,
    INTEGERS,
    OUTPUTS,
    PARAMETERS,
    TUNABLES,
    VARIABLES,
)
from slider_resonator.errors import unknown_name
from slider_resonator.scenes.expansion import with_bundles
from slider_resonator.scenes.key_table import NAMED, PARAMETER_MEANINGS
from slider_resonator.scenes.schema import RunTable, SceneTable
from slider_resonator.scenes.toml_file import toml_value

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


_NUMBERS = ("finite_number", "float_type", "greater_than", "greater_than_equal", "less_than")
"""Types of error whose explanation names the unit of the key."""


PLACES: Mapping[str, str] = {
    **dict.fromkeys(OUTPUTS, "an output cannot be set"),
    **dict.fromkeys(PARAMETERS, "a parameter must be in [device]"),
    **dict.fromkeys(TUNABLES, "a tunable parameter must be in [device] or in [tuning]"),
    **dict.fromkeys((*INPUTS, *DEVIATIONS), "an input must be in [inputs]"),
    **dict.fromkeys(RunTable.model_fields, "must be in [run]"),
    **dict.fromkeys(SceneTable.model_fields, "must be above the first heading"),
}
"""The table to which a key belongs that was found in another table."""


_TABLES = {("beside",), ("device",), ("inputs",), ("need",), ("run",), ("sweep",), ("tuning",)}


AXIS = ("<values>", "<range>")
"""Tags of the two forms of an axis of a grid; like that of a constant input they are no keys."""


def explanations(
    source: str,
    error: ValidationError,
    content: Mapping[str, Any],
    top: type[BaseModel] = SceneTable,
) -> list[str]:
    """Return one line per error in the content of a file: key path, value and requirement.

    `top` is the schema of the file. Of the errors of one kind in a list only the first is reported.
    """
    first: dict[tuple[object, ...], ErrorDetails] = {}
    for problem in error.errors():
        place = problem["loc"]
        in_list = bool(place) and isinstance(place[-1], int)
        first.setdefault((problem["type"], *(place[:-1] if in_list else place)), problem)
    return [f"{source}: {_explanation(problem, content, top)}" for problem in first.values()]


def _explanation(problem: ErrorDetails, content: Mapping[str, Any], top: type[BaseModel]) -> str:
    """Return key path, value and requirement of an error."""
    location = tuple(part for part in problem["loc"] if part not in ("constant", *AXIS))
    key, kind = _key_path(_named(location, content)), problem["type"]
    if not location:
        return problem["msg"].removeprefix("Value error, ")
    if kind == NAMED:
        return f"{key}.{problem['msg']}"
    if kind == "extra_forbidden":
        name, fields = str(location[-1]), _table_at(location, top).model_fields
        if top is SceneTable and name in PLACES and (len(location) > 1 or name not in fields):
            return f"{key}: unknown key {name!r}; {PLACES[name]}"
        known = [field.alias or other for other, field in fields.items()]
        return f"{key}: {unknown_name('key', name, known)}"
    if kind == "missing" and isinstance(location[-1], int):
        return f"{_key_path(location[:-1])}: must be a pair [time (s), value]"
    field = _field_at(location, top)
    if kind == "missing":
        examples = field.examples if field else None
        example = f"; add {location[-1]} = {toml_value(examples[0])}" if examples else ""
        return f"{key}: is missing{example}"
    value = problem["input"]
    text = str(value) if isinstance(value, date | time) else repr(value)
    shown = "" if isinstance(value, dict) else f" = {text}"
    wrong = problem["msg"].removeprefix("Value error, ")
    if kind in _REQUIREMENTS:
        wrong = "must be " + _REQUIREMENTS[kind].format(**problem.get("ctx", {}))
        wrong += _in_unit(location, field) if kind in _NUMBERS else ""
    if location == ("expect",):
        wrong = "must be a list of tables, each headed [[expect]]"
    in_points = len(location) > 1 and location[-2] in ("steps", "ramp")
    if in_points and isinstance(location[-1], int):
        wrong = "must be a pair [time (s), value]"
    if location in _TABLES and isinstance(value, list):
        wrong = f"must be one table, headed [{key}]"
    if problem["loc"][-1] == "constant" and str(value).lower().endswith(".csv"):
        wrong = f"must be a number, or a file such as {{ csv = {toml_value(value)} }}"
    if problem["loc"][-1] == "constant" and isinstance(value, list):
        wrong = (
            "must be a number, or values over time such as { steps = [[0.0, 0.0], [0.05, 0.04]] }"
        )
    return f"{key}{shown}: {wrong}"


def _in_unit(location: tuple[int | str, ...], field: Any) -> str:
    name = str(location[-1])
    if "device" in location and name in INTEGERS:
        return f": {PARAMETER_MEANINGS[name]}"
    unit = (field.json_schema_extra or {}).get("unit", "1") if field else "1"
    if "device" in location and name in PARAMETERS:
        unit = VARIABLES[name].unit or "1"
    return f", in {unit}" if unit not in ("1", "unit of the quantity") else ""


def _key_path(location: tuple[int | str, ...]) -> str:
    path = ""
    for part in location:
        path += f"[{part + 1}]" if isinstance(part, int) else f".{part}" if path else part
    return path


def _named(location: tuple[int | str, ...], content: Mapping[str, Any]) -> tuple[int | str, ...]:
    """Return a location with quantity and reference in place of the number of an expectation."""
    if len(location) < 2 or location[0] != "expect" or not isinstance(location[1], int):
        return location
    expect = with_bundles(content)["expect"][location[1]]
    known = [str(expect[key]) for key in ("quantity", "reference") if key in expect]
    return (f"expect[{', '.join(known)}]", *location[2:]) if known else location


def _field_at(location: tuple[int | str, ...], top: type[BaseModel]) -> Any:
    """Return the field of the key at a location of the schema, None inside a list or mapping."""
    name = location[-1]
    if isinstance(name, int):
        return None
    try:
        fields = _table_at(location, top).model_fields
        return next((one for key, one in fields.items() if name in (key, one.alias)), None)
    except (AttributeError, IndexError, KeyError):
        return None  # below a mapping of names, such as [device]


def _table_at(location: tuple[int | str, ...], top: type[BaseModel]) -> type[BaseModel]:
    """Return the table of the schema that has the last key of a location."""
    model = top
    for part in location[:-1]:
        if part in model.model_fields:
            model = _tables_in(model.model_fields[str(part)].annotation)[-1]
    return model


def _tables_in(annotation: Any) -> list[type[BaseModel]]:
    """Return the tables inside an annotation such as `RunTable | None`."""
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return [annotation]
    return [table for part in get_args(annotation) for table in _tables_in(part)]
