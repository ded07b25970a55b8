"""Values as TOML."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from typing import Any


def toml_value(value: object) -> str:
    """Return a number, text, list or mapping as a TOML value on one line."""
    if isinstance(value, Mapping):
        return f"{{ {', '.join(f'{key} = {toml_value(v)}' for key, v in value.items())} }}"
    if isinstance(value, Sequence) and not isinstance(value, str):
        return f"[{', '.join(map(toml_value, value))}]"
    return json.dumps(value, ensure_ascii=False)


def toml_text(content: Mapping[str, Any]) -> str:
    """Return the content of a scene as the text of its file, a heading for each table."""
    tables = {key: value for key, value in content.items() if isinstance(value, Mapping)}
    blocks: list[tuple[str, Mapping[str, Any]]]
    blocks = [("", {key: v for key, v in content.items() if key not in {*tables, "expect"}})]
    blocks += [(f"[{key}]\n", table) for key, table in tables.items()]
    blocks += [("[[expect]]\n", table) for table in content.get("expect", ())]
    return "\n".join(
        heading + "".join(f"{key} = {toml_value(value)}\n" for key, value in table.items())
        for heading, table in blocks
    )
