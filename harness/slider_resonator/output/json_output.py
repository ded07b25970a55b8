"""The JSON of all commands and result files: a schema version, no NaN, no infinity.

The keys are a public interface, pinned in tests/harness/public_json.toml. A renamed field keeps its
public key; a key that goes or changes its meaning raises the schema version.
"""

import json
from collections.abc import Mapping
from dataclasses import fields, is_dataclass
from math import isfinite
from pathlib import Path
from typing import Any

import numpy as np

SCHEMA_VERSION = 1


def to_json(result: Any, provenance: Any = None) -> str:
    """Return a dataclass, a mapping or a list of them as indented JSON.

    Each top-level object begins with `schema_version`, and `provenance` where it is given. A
    complex number becomes [real, imaginary]; a value that is not finite becomes null.
    """
    head: dict[str, Any] = {"schema_version": SCHEMA_VERSION}
    if provenance is not None:
        head["provenance"] = plain(provenance)
    document = plain(result)
    headed = [head | one for one in document] if isinstance(document, list) else head | document
    text = json.dumps(headed, indent=2, allow_nan=False)
    # In strings only: GitHub Actions finds commands of this form anywhere in a line of a log.
    return text.replace("##[", "\\u0023#[")


def plain(value: Any) -> Any:
    """Return dataclasses, mappings, lists and arrays as JSON has them; not finite ones as None."""
    if is_dataclass(value) and not isinstance(value, type):
        return {f.name: plain(getattr(value, f.name)) for f in fields(value)}
    if isinstance(value, Mapping):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, tuple | list):
        return [plain(item) for item in value]
    if isinstance(value, np.ndarray):
        return plain(value.tolist())
    if isinstance(value, Path):
        return str(value)
    if isinstance(value, complex):
        return [plain(value.real), plain(value.imag)]
    if isinstance(value, float):
        return float(value) if isfinite(value) else None
    return value
