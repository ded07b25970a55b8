"""What long work has finished, kept in a file, so that it can go on after it was stopped."""

from __future__ import annotations

import json
import os
import zlib
from collections.abc import Iterable, Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any, BinaryIO

from slider_resonator.errors import HarnessError

try:
    import fcntl
except ImportError:  # Windows: two writers of one file are then not noticed
    fcntl = None  # type: ignore[assignment]

FORMAT = 3


class Journal:
    """One line of JSON for each entry, after a line that says of which work it is.

    `work` says what is kept, such as "sweep"; `digest` must be another for other work of this kind;
    `remedy` is for messages. Each line begins with a checksum. A line that was cut off by the end
    of its writer is dropped, and so are those whose numbers are in `damaged`: what they held is to
    be done again. `entries` are those found in the file, by line. With `restart` all that it holds
    is discarded. Raises HarnessError for the journal of other work, for a file that is none, and
    while another process writes it. Use it in a `with` block.
    """

    def __init__(
        self, path: Path, work: str, digest: str, remedy: str, *, restart: bool = False
    ) -> None:
        self.path = path
        self.entries: dict[int, Any] = {}
        self.damaged: list[int] = []
        self._work, self._remedy = work, remedy
        try:
            self._file: BinaryIO = path.open("a+b")
            try:
                self._lock()
                if restart:
                    self._file.truncate(0)
                self._read({"format": FORMAT, work: digest})
            except BaseException:
                self._file.close()
                raise
        except OSError as error:
            raise HarnessError(f"{path}: cannot be written: {error.strerror}") from error

    def add(self, entries: Iterable[object]) -> None:
        """Keep entries, which JSON can write; they survive the end of this process."""
        self._write(map(_line, entries))

    def remove(self) -> None:
        """Remove the file: what is made from it has been written."""
        self.path.unlink(missing_ok=True)

    def __enter__(self) -> Journal:
        """Return this."""
        return self

    def __exit__(self, *error: object) -> None:
        """Close the file."""
        with suppress(OSError):  # of a full disk, which `add` has reported
            self._file.close()

    def _lock(self) -> None:
        if fcntl is None:
            return
        try:
            fcntl.flock(self._file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError as error:
            raise HarnessError(f"{self.path}: another {self._work} is writing it") from error

    def _read(self, header: Mapping[str, object]) -> None:
        """Read the entries; drop a line that was cut off at the end, and those that are damaged."""
        self._file.seek(0)
        lines = self._file.read().splitlines(keepends=True)
        for number, line in enumerate(lines, start=1):
            if not line.endswith(b"\n"):
                continue
            entry = _entry(line)
            if number == 1:
                self._check(entry, header)
            elif entry is None:
                self.damaged.append(number)
            else:
                self.entries[number] = entry
        if self.damaged or not lines or not lines[-1].endswith(b"\n"):
            self._file.truncate(0)
            self._write(map(_line, [header, *self.entries.values()]))
        self._file.seek(0, os.SEEK_END)

    def _check(self, found: object, header: Mapping[str, object]) -> None:
        if not isinstance(found, dict) or self._work not in found:
            raise HarnessError(
                f"{self.path} line 1: is no journal of a {self._work}, or damaged; {self._remedy}"
            )
        if found != header:
            raise HarnessError(
                f"{self.path}: is of another {self._work}, another FMU or another version; "
                f"{self._remedy}"
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
