"""The JSON of all commands and result files: a schema version, no NaN, no infinity.

The keys are a public interface, pinned in tests/harness/public_json.toml. A renamed field keeps its
public key; a key that goes or changes its meaning raises the schema version.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import fields, is_dataclass
from math import isfinite
from typing import Any

SCHEMA_VERSION = 1


def to_json(result: Any) -> str:
    """Return a dataclass, a mapping or a list of them as indented JSON.

    Each object at the top begins with `schema_version`. A complex number becomes [real, imaginary];
    what is not finite becomes null.
    """
    text = json.dumps(_versioned(_plain(result)), indent=2, allow_nan=False)
    # In strings only: GitHub Actions finds commands of this form anywhere in a line of a log.
    return text.replace("##[", "\\u0023#[")


def _versioned(document: Any) -> Any:
    if isinstance(document, list):
        return [_versioned(entry) for entry in document]
    return {"schema_version": SCHEMA_VERSION, **document}


def _plain(value: Any) -> Any:
    if is_dataclass(value) and not isinstance(value, type):
        return {f.name: _plain(getattr(value, f.name)) for f in fields(value)}
    if isinstance(value, Mapping):
        return {str(key): _plain(item) for key, item in value.items()}
    if isinstance(value, tuple | list):
        return [_plain(item) for item in value]
    if isinstance(value, complex):
        return [_plain(value.real), _plain(value.imag)]
    if isinstance(value, float):
        return float(value) if isfinite(value) else None
    return value
