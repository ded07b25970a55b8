"""The JSON schema of scene files, with which editors complete and check them."""

import json
from collections.abc import Mapping
from typing import Any

from pydantic.json_schema import GenerateJsonSchema, JsonSchemaValue
from pydantic_core import core_schema

from slider_resonator.scenes.expansion import bundles
from slider_resonator.scenes.key_table import NUMBER_OR_TEXT
from slider_resonator.scenes.schema import ExpectTable, InputTable, RunTable, SceneTable
from slider_resonator.scenes.vocabulary import QUANTITIES


def scene_schema() -> dict[str, Any]:
    """Return the JSON schema (draft 2020-12) of a scene file.

    Of a file with variants or bundles, which give what a table leaves out, any part is accepted.
    """
    scene = SceneTable.model_json_schema(schema_generator=_InEditors)
    tables = scene.pop("$defs")
    properties = scene["properties"]
    properties["expect_bundles"]["items"] = {"enum": list(bundles())}
    device = {"$ref": properties["device"].pop("$ref")}
    properties["device"]["anyOf"] = [device, {"type": "string"}]  # or its name or file
    for table in (InputTable, RunTable, ExpectTable):
        tables[table.__name__]["allOf"] = [
            {"oneOf": [{"required": [key]} for key in group]} for group in table.one_of
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


class _InEditors(GenerateJsonSchema):
    """What an editor needs: no null for a key that is left out, no defaults of whole tables."""

    def nullable_schema(self, schema: core_schema.NullableSchema) -> JsonSchemaValue:
        """Return what a key has that is not left out."""
        return self.generate_inner(schema["schema"])

    def default_schema(self, schema: core_schema.WithDefaultSchema) -> JsonSchemaValue:
        """Return a value with its default, if that is a number or a text."""
        inner, default = self.generate_inner(schema["schema"]), schema.get("default")
        return {**inner, "default": default} if isinstance(default, str | float) else inner

    def float_schema(self, schema: core_schema.FloatSchema) -> JsonSchemaValue:
        """Return a number, or a text with a unit."""
        return {**super().float_schema(schema), **NUMBER_OR_TEXT}
