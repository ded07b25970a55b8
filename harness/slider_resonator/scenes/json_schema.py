"""The JSON schema of scene files, with which editors complete and check them."""

import json
from collections.abc import Mapping
from typing import Any

from slider_resonator.scenes.expansion import bundles
from slider_resonator.scenes.key_table import NUMBER_OR_TEXT
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
_WITHOUT_UNIT = ("drive_periods", "steps_per_period")
"""Numbers that are counts; any other may be a text with a unit."""


def scene_schema() -> dict[str, Any]:
    """Return the JSON schema (draft 2020-12) of a scene file.

    Of a file with variants or bundles, which give what a table leaves out, any part is accepted.
    """
    scene: dict[str, Any] = _with_units(_without_null(SceneTable.model_json_schema()))
    tables = scene.pop("$defs")
    scene["properties"]["expect_bundles"]["items"] = {"enum": list(bundles())}
    scene["properties"]["device"]["type"] = ["object", "string"]  # or a name or file of a device
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
    quantity = tables["ExpectTable"]["properties"]["quantity"]
    quantity["anyOf"] = [{"enum": quantity.pop("enum")}]
    quantity["anyOf"] += [{"type": "array", "minItems": 1, "items": quantity["anyOf"][0]}]
    del quantity["type"]
    parts = {f"Part{name}": _part(table) for name, table in tables.items()}
    family = _part(scene)
    one_of_family = {**family, "required": ["name"]}
    family["properties"]["variant"]["items"] = {"$ref": "#/$defs/VariantTable"}
    tables |= {"VariantTable": one_of_family, **parts}
    for name in ("InputTable", "PartInputTable"):
        tables[name] = {"anyOf": [NUMBER_OR_TEXT, tables[name]]}
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "Scene of slider-resonator",
        "if": {"anyOf": [{"required": ["variant"]}, {"required": ["expect_bundles"]}]},
        "then": family,
        "else": scene,
        "$defs": tables,
    }


def _part(table: Mapping[str, Any]) -> dict[str, Any]:
    """Return a copy of the schema of a table of which nothing is required."""
    text = json.dumps({key: table[key] for key in table if key not in ("required", "allOf")})
    part: dict[str, Any] = json.loads(text.replace("#/$defs/", "#/$defs/Part"))
    return part


def _with_units(schema: Any) -> Any:
    """Return a schema that takes a text with a unit in place of each number that may have one."""
    if isinstance(schema, list):
        return [_with_units(entry) for entry in schema]
    if not isinstance(schema, dict):
        return schema
    kept = ("examples", "default", *_WITHOUT_UNIT)
    found = {key: value if key in kept else _with_units(value) for key, value in schema.items()}
    return {**found, **NUMBER_OR_TEXT} if found.get("type") == "number" else found


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
