"""Problems of a scene file in words: file, key, value, what is allowed."""

from __future__ import annotations

from typing import Any

from pydantic import BaseModel, ValidationError

from harness.names import unknown_name
from harness.scene_model import SceneTable


def explanations(source: str, error: ValidationError) -> list[str]:
    """Return one line per problem: file, key path, value, what is allowed."""
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
            message = problem["msg"].removeprefix("Value error, ")
            value = problem["input"]
            shown = "" if isinstance(value, dict) else f" = {value!r}"
            lines.append(f"{source}: {key}{shown}: {message}")
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
