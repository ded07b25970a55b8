"""The finished points of a sweep, kept beside its table until that is written."""

from __future__ import annotations

import json
import os
from collections.abc import Iterable
from pathlib import Path
from typing import Any, BinaryIO

from slider_resonator.errors import HarnessError
from slider_resonator.studies.sweep.worker import Row

try:
    import fcntl
except ImportError:  # Windows: two sweeps into one file are then not noticed
    fcntl = None  # type: ignore[assignment]

FORMAT = 1


def journal_path(table: Path) -> Path:
    """Return where the journal of a table is."""
    return table.with_name(f"{table.name}.journal")


class Journal:
    """One line of JSON for each finished point, after a line that says which sweep it is.

    A line that was cut off by the end of its writer is dropped, and its point is computed again.
    With `restart` all that the file holds is discarded.
    Raises HarnessError for the journal of another sweep, for a file that is none, and while another
    process writes it.
    """

    def __init__(self, path: Path, digest: str, *, restart: bool = False) -> None:
        self.path = path
        self.rows: dict[int, Row] = {}
        try:
            self._file: BinaryIO = path.open("a+b")
            self._lock()
            try:
                if restart:
                    self._file.truncate(0)
                self._read(digest)
            except BaseException:
                self._file.close()
                raise
        except OSError as error:
            raise HarnessError(f"{path}: cannot be written: {error.strerror}") from error

    def add(self, rows: Iterable[Row]) -> None:
        """Keep rows; they survive the end of this process."""
        lines = []
        for row in rows:
            self.rows[row[0]] = row
            lines.append(_line(row))
        self._write(lines)

    def remove(self) -> None:
        """Remove the journal: its table has been written."""
        self.path.unlink(missing_ok=True)

    def __enter__(self) -> Journal:
        return self

    def __exit__(self, *error: object) -> None:
        self._file.close()

    def _lock(self) -> None:
        if fcntl is None:
            return
        try:
            fcntl.flock(self._file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError as error:
            self._file.close()
            raise HarnessError(f"{self.path}: another sweep is writing it") from error

    def _read(self, digest: str) -> None:
        self._file.seek(0)
        sound = 0
        for number, line in enumerate(self._file):
            entry = _entry(line)
            if entry is None:
                if number == 0 and line.endswith(b"\n"):
                    raise HarnessError(
                        f"{self.path}: is no journal of a sweep; move it away, or discard it "
                        "with --restart"
                    )
                break
            if number == 0:
                self._check(entry, digest)
            else:
                point, cells, failure = entry
                self.rows[point] = (point, cells, failure)
            sound += len(line)
        self._file.truncate(sound)
        self._file.seek(0, os.SEEK_END)
        if sound == 0:
            self._write([_line({"format": FORMAT, "sweep": digest})])

    def _check(self, header: object, digest: str) -> None:
        if header != {"format": FORMAT, "sweep": digest}:
            raise HarnessError(
                f"{self.path}: holds points of another sweep, another FMU or another version; "
                "--restart discards them"
            )

    def _write(self, lines: Iterable[str]) -> None:
        try:
            self._file.write("".join(lines).encode())
            self._file.flush()
        except OSError as error:
            raise HarnessError(f"{self.path}: cannot be written: {error.strerror}") from error


def _line(entry: object) -> str:
    return json.dumps(entry, separators=(",", ":")) + "\n"


def _entry(line: bytes) -> Any:
    """Return the content of a line, None for an incomplete one."""
    if not line.endswith(b"\n"):
        return None
    try:
        return json.loads(line)
    except ValueError:
        return None
