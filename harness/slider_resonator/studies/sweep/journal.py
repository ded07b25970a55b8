"""The finished points of a sweep, kept beside its table until that is written."""

from __future__ import annotations

import json
import os
import zlib
from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path
from typing import Any, BinaryIO

from slider_resonator.errors import HarnessError
from slider_resonator.studies.sweep.worker import Row

try:
    import fcntl
except ImportError:  # Windows: two sweeps into one file are then not noticed
    fcntl = None  # type: ignore[assignment]

FORMAT = 2


def journal_path(table: Path) -> Path:
    """Return where the journal of a table is."""
    return table.with_name(f"{table.name}.journal")


class Journal:
    """One line of JSON for each finished point, after a line that says which sweep it is.

    Each begins with a checksum. A line that was cut off by the end of its writer is dropped, and so
    are those whose numbers are in `damaged`: their points are computed again. With `restart` all
    that the file holds is discarded.
    Raises HarnessError for the journal of another sweep, for a file that is none, and while another
    process writes it.
    """

    def __init__(self, path: Path, digest: str, *, restart: bool = False) -> None:
        self.path = path
        self.rows: dict[int, Row] = {}
        self.damaged: list[int] = []
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
        with suppress(OSError):  # of a full disk, which `add` has reported
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
        """Read the rows; drop a line that was cut off at the end, and those that are damaged."""
        self._file.seek(0)
        lines = self._file.read().splitlines(keepends=True)
        for number, line in enumerate(lines, start=1):
            whole = line.endswith(b"\n")
            entry = _entry(line) if whole else None
            if number == 1:
                if whole:
                    self._check(entry, digest)
            elif entry is None:
                if whole:
                    self.damaged.append(number)
            else:
                self._keep(number, entry)
        if self.damaged or not lines or not lines[-1].endswith(b"\n"):
            self._file.truncate(0)
            self._write([_line({"format": FORMAT, "sweep": digest}), *map(_line, self._in_order())])
        self._file.seek(0, os.SEEK_END)

    def _in_order(self) -> list[Row]:
        return list(self.rows.values())

    def _keep(self, number: int, entry: object) -> None:
        """Keep the row of a line; HarnessError for what is sound and no row."""
        match entry:
            case [int(point), list(cells), None | str() as failure]:
                self.rows[point] = (point, cells, failure)
            case _:
                raise HarnessError(
                    f"{self.path} line {number}: is no point of a sweep; must be number, results "
                    "and error; --restart discards the file"
                )

    def _check(self, header: object, digest: str) -> None:
        if not isinstance(header, dict) or "sweep" not in header:
            raise HarnessError(
                f"{self.path} line 1: is no journal of a sweep, or damaged; move the file away, or "
                "discard it with --restart"
            )
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
    text = json.dumps(entry, separators=(",", ":"))
    return f"{_checksum(text.encode())} {text}\n"


def _entry(line: bytes) -> Any:
    """Return the content of a line, None for one that is damaged."""
    checksum, _, text = line.rstrip(b"\n").partition(b" ")
    if checksum != _checksum(text).encode():
        return None
    try:
        return json.loads(text)
    except ValueError:
        return None


def _checksum(text: bytes) -> str:
    return f"{zlib.crc32(text):08x}"
