"""Changes of the C sources, as data: faults that scenes must reject, variants they must accept."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from importlib import resources
from typing import Any

from slider_resonator.errors import HarnessError


@dataclass(frozen=True)
class Change:
    """One change of a C file: the text `old`, which occurs once in `file`, becomes `new`.

    `meaning` is what physics a fault breaks or why a variant is harmless. `survives` is the reason
    why no scene can see a fault, empty for all others.
    """

    name: str
    file: str
    old: str
    new: str
    meaning: str
    harmless: bool = False
    survives: str = ""

    def applied(self, sources: Mapping[str, str]) -> str:
        """Return the changed text of the file; `sources` are texts by file name.

        Raises HarnessError, with the name of the change, where `old` does not occur once.
        """
        if self.file not in sources:
            raise HarnessError(f"{self.name}: {self.file} is not among the C sources")
        text = sources[self.file]
        count = text.count(self.old)
        if count != 1:
            raise HarnessError(
                f"{self.name}: {self.old!r} occurs {count} times in {self.file}; must be once"
            )
        return text.replace(self.old, self.new)


def hand_written_faults() -> list[Change]:
    """Return the faults, in the order of their file."""
    return [_change(entry, "breaks") for entry in _entries("faults.toml", "fault")]


def harmless_variants() -> list[Change]:
    """Return the variants, in the order of their file."""
    entries = _entries("variants.toml", "variant")
    return [_change(entry, "why", harmless=True) for entry in entries]


def _entries(file: str, key: str) -> list[dict[str, Any]]:
    path = resources.files(__package__) / file
    entries: list[dict[str, Any]] = tomllib.loads(path.read_text(encoding="utf-8"))[key]
    return entries


def _change(entry: Mapping[str, str], meaning: str, *, harmless: bool = False) -> Change:
    return Change(
        entry["name"],
        entry["file"],
        entry["old"],
        entry["new"],
        entry[meaning],
        harmless,
        entry.get("survives", ""),
    )
