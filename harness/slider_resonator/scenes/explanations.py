"""Explain the errors of a scene file: file, key, value and requirement."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from pydantic import BaseModel, ValidationError
from pydantic_core import ErrorDetails

from slider_resonator.errors import unknown_name
from slider_resonator.scenes.schema import SceneTable
from slider_resonator.scenes.toml_text import toml_value

_REQUIREMENTS: Mapping[str, str] = {
    "dict_type": "a table of keys and values",
    "bool_type": "true or false",
    "finite_number": "a finite number",
    "float_type": "a number",
    "greater_than": "a number above {gt:g}",
    "greater_than_equal": "a number not below {ge:g}",
    "less_than": "a number below {lt:g}",
    "literal_error": "{expected}",
    "model_type": "a table of keys and values",
    "string_pattern_mismatch": "a word of letters, digits, _ and -",
    "string_type": "a text in quotes",
    "too_long": "a list of {max_length} numbers",
    "too_short": "a list of at least {min_length} number",
    "tuple_type": "a list in brackets",
}
"""What a value must be, by the type of error that pydantic finds."""


_NUMBERS = ("finite_number", "float_type", "greater_than", "greater_than_equal", "less_than")
"""Types of error for which the unit of a key is worth a word."""


def explanations(source: str, error: ValidationError) -> list[str]:
    """Return one line per error: file, key path, value and requirement."""
    return [f"{source}: {_explanation(problem)}" for problem in error.errors()]


def _explanation(problem: ErrorDetails) -> str:
    """Return key path, value and requirement of an error."""
    location = tuple(part for part in problem["loc"] if part != "constant")
    key, kind = _key_path(location), problem["type"]
    if not location:
        return problem["msg"].removeprefix("Value error, ")
    if kind == "extra_forbidden":
        return f"{key}: {unknown_name('key', str(location[-1]), _table_at(location).model_fields)}"
    if kind == "missing" and isinstance(location[-1], int):
        return f"{_key_path(location[:-1])}: must be a pair [time (s), value]"
    field = _field_at(location)
    if kind == "missing":
        example = f"; add {location[-1]} = {toml_value(field.examples[0])}" if field else ""
        return f"{key}: is missing{example}"
    value = problem["input"]
    shown = "" if isinstance(value, dict) else f" = {value!r}"
    wrong = problem["msg"].removeprefix("Value error, ")
    if kind in _REQUIREMENTS:
        wrong = "must be " + _REQUIREMENTS[kind].format(**problem.get("ctx", {}))
        wrong += _in_unit(field) if kind in _NUMBERS else ""
    if location == ("expect",):
        wrong = "must be a list of tables, each headed [[expect]]"
    return f"{key}{shown}: {wrong}"


def _in_unit(field: Any) -> str:
    unit = (field.json_schema_extra or {}).get("unit", "1") if field else "1"
    return f", in {unit}" if unit not in ("1", "unit of the quantity") else ""


def _key_path(location: tuple[int | str, ...]) -> str:
    path = ""
    for part in location:
        path += f"[{part}]" if isinstance(part, int) else f".{part}" if path else part
    return path


def _field_at(location: tuple[int | str, ...]) -> Any:
    """Return the field of the key at a location of the schema, None inside a list or mapping."""
    name = location[-1]
    if isinstance(name, int):
        return None
    try:
        return _table_at(location).model_fields.get(name)
    except (AttributeError, IndexError, KeyError):
        return None  # below a mapping of names, such as [device]


def _table_at(location: tuple[int | str, ...]) -> type[BaseModel]:
    """Return the table of the schema that has the last key of a location."""
    model: type[BaseModel] = SceneTable
    for part in location[:-1]:
        if not isinstance(part, int):
            model = _table_of(model.model_fields[part].annotation)
    return model


def _table_of(annotation: Any) -> type[BaseModel]:
    """Return the table class inside an annotation such as `RunTable | None`."""
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return annotation
    tables = [a for a in annotation.__args__ if isinstance(a, type) and issubclass(a, BaseModel)]
    return tables[0]
