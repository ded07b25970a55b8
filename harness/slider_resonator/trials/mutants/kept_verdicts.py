"""The verdicts of a mutation run, kept in a file as they come, so that a run can go on."""

from __future__ import annotations

import json
import zlib
from collections.abc import Iterable
from pathlib import Path
from typing import TextIO

from slider_resonator.errors import HarnessError
from slider_resonator.trials.mutants.mutant import Mutant
from slider_resonator.trials.mutants.verdict import MutantVerdict

_PARTS = ("status", "reason", "scene", "quantity")


class KeptVerdicts:
    """One line of JSON for each verdict, each with a checksum, after a line that names the run.

    A line that is damaged or cut off is dropped: its mutant is tried again. Raises HarnessError for
    a file of another run, and one that cannot be written.
    """

    def __init__(self, path: Path, digest: str, mutants: Iterable[Mutant]) -> None:
        self._path = path
        by_name = {mutant.name: mutant for mutant in mutants}
        self.verdicts: dict[str, MutantVerdict] = {}
        try:
            entries = [_entry(line) for line in path.read_text(encoding="utf-8").splitlines()]
        except FileNotFoundError:
            entries = []
        except (OSError, UnicodeDecodeError) as error:
            raise HarnessError(f"{path}: cannot be read: {error}") from error
        if entries and entries[0] != [digest]:
            raise HarnessError(
                f"{path}: holds verdicts of another run; must be of this FMU, these scenes and "
                "probes: move it away or name another file"
            )
        for entry in entries[1:]:
            if entry is not None and entry[0] in by_name:
                mutant = by_name[entry[0]]
                values = dict(zip(_PARTS, entry[1:], strict=True))
                self.verdicts[mutant.name] = MutantVerdict(mutant, **values)
        try:
            self._file: TextIO = path.open("a", encoding="utf-8")
        except OSError as error:
            raise HarnessError(f"{path}: cannot be written: {error.strerror}") from error
        self._write([""] if entries else [_line([digest])])

    def add(self, verdict: MutantVerdict) -> None:
        """Keep a verdict; it survives the end of this process."""
        self.verdicts[verdict.mutant.name] = verdict
        parts = [getattr(verdict, part) for part in _PARTS]
        self._write([_line([verdict.mutant.name, *parts])])

    def close(self) -> None:
        """Close the file."""
        self._file.close()

    def _write(self, lines: list[str]) -> None:
        try:
            self._file.write("".join(f"{line}\n" for line in lines))
            self._file.flush()
        except OSError as error:
            raise HarnessError(f"{self._path}: cannot be written: {error.strerror}") from error


def _line(entry: list[str]) -> str:
    text = json.dumps(entry)
    return f"{zlib.crc32(text.encode()):08x} {text}"


def _entry(line: str) -> list[str] | None:
    """Return the content of a line, None for one that is damaged or empty."""
    checksum, _, text = line.partition(" ")
    if checksum != f"{zlib.crc32(text.encode()):08x}":
        return None
    entry: list[str] = json.loads(text)
    return entry
