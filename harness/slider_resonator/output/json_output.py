"""Results as JSON that every reader accepts: no NaN, no infinity, complex numbers as pairs."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import fields, is_dataclass
from math import isfinite
from typing import Any


def to_json(result: Any) -> str:
    """Return dataclasses, mappings, sequences and numbers as indented JSON.

    A complex number becomes [real, imaginary]; what is not finite becomes null.
    """
    return json.dumps(_plain(result), indent=2, allow_nan=False)


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
