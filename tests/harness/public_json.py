"""The public keys of JSON documents, which users' programs read by name."""

import json
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

LISTED = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))


def assert_public_keys(name: str, printed: str) -> None:
    """Compare the keys of a printed document with those listed for `name`."""
    listed = set(_places(name))
    for place in [place for place in listed if place.split(".")[-1] == "provenance"]:
        listed |= {f"{place}.{key}" for key in _places("provenance")}
    assert set(_keys(json.loads(printed), "", listed)) == listed


def _places(name: str) -> Iterator[str]:
    for place, keys in LISTED[name].items():
        for key in keys.split():
            yield f"{place}.{key}".lstrip(".")


def _keys(value: Any, place: str, listed: set[str]) -> Iterator[str]:
    if isinstance(value, list):
        for entry in value:
            yield from _keys(entry, f"{place}[]", listed)
    elif isinstance(value, dict):
        free = f"{place}.*"
        for key, entry in value.items():
            path = free if free in listed else f"{place}.{key}".lstrip(".")
            yield path
            yield from _keys(entry, path, listed)
