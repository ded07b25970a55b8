"""Explain the errors of a scene file: file, key, value and requirement."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from pydantic import BaseModel, ValidationError

from slider_resonator.errors import unknown_name
from slider_resonator.scenes.schema import SceneTable

_REQUIREMENTS: Mapping[str, str] = {
    "dict_type": "a table of keys and values",
    "bool_type": "true or false",
    "finite_number": "a finite number",
    "float_type": "a number",
    "greater_than": "a number above {gt:g}",
    "greater_than_equal": "a number not below {ge:g}",
    "literal_error": "{expected}",
    "model_type": "a table of keys and values",
    "string_pattern_mismatch": "a word of letters, digits, _ and -",
    "string_type": "a text in quotes",
    "too_long": "a list of {max_length} numbers",
    "too_short": "a list of at least {min_length} number",
    "tuple_type": "a list in brackets",
}
"""What a value must be, by the type of error that pydantic finds."""


def explanations(source: str, error: ValidationError) -> list[str]:
    """Return one line per error: file, key path, value and requirement."""
    lines = []
    for problem in error.errors():
        location = tuple(part for part in problem["loc"] if part != "constant")
        key = _key_path(location)
        if problem["type"] == "extra_forbidden":
            allowed = _allowed_keys(location[:-1])
            lines.append(f"{source}: {key}: {unknown_name('key', str(location[-1]), allowed)}")
        elif problem["type"] == "missing":
            lines.append(f"{source}: {key}: is missing")
        else:
            value = problem["input"]
            shown = "" if isinstance(value, dict) else f" = {value!r}"
            wrong = problem["msg"].removeprefix("Value error, ")
            if problem["type"] in _REQUIREMENTS:
                wrong = "must be " + _REQUIREMENTS[problem["type"]].format(**problem.get("ctx", {}))
            if location == ("expect",):
                wrong = "must be a list of tables, each headed [[expect]]"
            lines.append(f"{source}: {key}{shown}: {wrong}")
    return lines


def _key_path(location: tuple[int | str, ...]) -> str:
    path = ""
    for part in location:
        path += f"[{part}]" if isinstance(part, int) else f".{part}" if path else part
    return path or "the file"


def _allowed_keys(location: tuple[int | str, ...]) -> list[str]:
    """Return the keys of the table at a location of the schema."""
    model: Any = SceneTable
    for part in location:
        if isinstance(part, int):
            continue
        model = _table_of(model.model_fields[part].annotation)
    return list(model.model_fields)


def _table_of(annotation: Any) -> type[BaseModel]:
    """Return the table class inside an annotation such as `RunTable | None`."""
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return annotation
    tables = [a for a in annotation.__args__ if isinstance(a, type) and issubclass(a, BaseModel)]
    return tables[0]
