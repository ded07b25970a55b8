"""Changes of the C sources, as data: faults that scenes must reject, variants they must accept."""

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from importlib import resources

from slider_resonator.errors import HarnessError


@dataclass(frozen=True)
class Change:
    """One change of a C file: the text `old`, which occurs once in `file`, becomes `new`.

    `meaning` is what a fault breaks, or why a variant is harmless.
    """

    name: str
    file: str
    old: str
    new: str
    meaning: str
    harmless: bool = False

    @property
    def kind(self) -> str:
        """Either "fault" or "harmless"."""
        return "harmless" if self.harmless else "fault"

    @property
    def diff(self) -> str:
        """File and meaning, the lines that are replaced, then those in their place."""
        old = [f"-{line}" for line in self.old.splitlines()]
        new = [f"+{line}" for line in self.new.splitlines()]
        return "\n".join([f"{self.file}: {self.meaning}", *old, *new])

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


def hand_written_changes() -> list[Change]:
    """Return the faults, then the harmless variants, in the order of their files."""
    folder = resources.files(__package__)
    return [
        *changes_in((folder / "faults.toml").read_text(encoding="utf-8")),
        *changes_in((folder / "variants.toml").read_text(encoding="utf-8"), harmless=True),
    ]


def changes_in(text: str, *, harmless: bool = False) -> list[Change]:
    """Return the changes in a TOML text: tables of names below those of files."""
    return [
        Change(name, file, entry["old"], entry["new"], entry["what"], harmless)
        for file, entries in tomllib.loads(text).items()
        for name, entry in entries.items()
    ]
