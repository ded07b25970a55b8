"""The JSON schema of scene files, with which editors complete and check them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from slider_resonator.scenes.schema import SceneTable
from slider_resonator.scenes.vocabulary import QUANTITIES

_ONE_OF: Mapping[str, tuple[tuple[str, ...], ...]] = {
    "InputTable": (("constant", "steps", "ramp", "csv"),),
    "RunTable": (
        ("stop_time", "drive_periods"),
        ("step_size", "steps_per_period", "step_sizes"),
    ),
    "ExpectTable": (("reference", "value", "at_most", "at_least"),),
}
"""Keys of a table of which there must be exactly one."""


def scene_schema() -> dict[str, Any]:
    """Return the JSON schema (draft 2020-12) of a scene file."""
    schema: dict[str, Any] = _without_null(SceneTable.model_json_schema())
    tables = schema["$defs"]
    for name, groups in _ONE_OF.items():
        tables[name]["allOf"] = [
            {"oneOf": [{"required": [key]} for key in group]} for group in groups
        ]
    tables["ExpectTable"]["allOf"] += [
        {
            "if": {"properties": {"quantity": {"const": name}}},
            "then": {"properties": {"reference": {"enum": list(quantity.references)}}},
        }
        for name, quantity in QUANTITIES.items()
    ]
    tables["InputTable"] = {"anyOf": [{"type": "number"}, tables["InputTable"]]}
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        **schema,
        "title": "Scene of slider-resonator",
    }


def _without_null(schema: Any) -> Any:
    """Return a schema without what only Python knows: null, titles, defaults of whole tables."""
    if isinstance(schema, list):
        return [_without_null(entry) for entry in schema if entry != {"type": "null"}]
    if not isinstance(schema, dict):
        return schema
    short = {
        name: value if name == "examples" else _without_null(value)
        for name, value in schema.items()
        if not (name == "title" and isinstance(value, str))
        and not (name == "default" and (value is None or isinstance(value, dict | list)))
    }
    choices = short.get("anyOf", ())
    if len(choices) != 1:
        return short
    del short["anyOf"]
    return {**choices[0], **short}
