"""What long work has finished, kept in a file, so that it can go on after it was stopped."""

import json
import sqlite3
import zlib
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from slider_resonator.errors import HarnessError

APPLICATION = 0x736C7264
"""Marks an SQLite file as a journal of this package."""
_ENCODER = json.JSONEncoder(separators=(",", ":"))
TABLES = (
    "CREATE TABLE work (kind TEXT, digest TEXT)",
    "CREATE TABLE entries (number INTEGER PRIMARY KEY, checksum INTEGER, entry TEXT)",
)


class Journal:
    """An SQLite file of entries, which JSON can write, and of the work that they belong to.

    `work` says what is kept, such as "sweep"; `digest` must be another for other work of this kind;
    `remedy` is for messages. `entries` are those found in the file, by number from 1. One whose
    checksum is wrong is dropped and its number is in `damaged`: what it held is to be done again.
    With `restart` all that it holds is discarded. Raises HarnessError for the journal of other
    work, for a file that is none, which stays as it is, and while another process writes it. Use it
    in a `with` block.
    """

    def __init__(
        self, path: Path, work: str, digest: str, remedy: str, *, restart: bool = False
    ) -> None:
        self.path = path
        self.entries: dict[int, Any] = {}
        self.damaged: list[int] = []
        self._work, self._remedy = work, remedy
        with self._explained():
            with path.open("ab") as file:
                is_new = file.tell() == 0
            self._file = sqlite3.connect(path, timeout=0.0, isolation_level=None)
            try:
                # Entries need to survive the end of this process, not that of the machine.
                self._file.execute("PRAGMA synchronous = OFF")
                self._file.execute("PRAGMA locking_mode = EXCLUSIVE")
                self._file.execute("BEGIN EXCLUSIVE")
                if not is_new:
                    self._check(digest, restart=restart)
                if is_new or restart:
                    self._file.execute("DROP TABLE IF EXISTS work")
                    self._file.execute("DROP TABLE IF EXISTS entries")
                    for table in TABLES:
                        self._file.execute(table)
                    self._file.execute(f"PRAGMA application_id = {APPLICATION}")
                    self._file.execute("INSERT INTO work VALUES (?, ?)", (work, digest))
                self._file.execute("COMMIT")
            except BaseException:
                self._file.close()
                raise

    def add(self, entries: Iterable[object]) -> None:
        """Keep entries; they survive the end of this process."""
        texts = [_ENCODER.encode(entry) for entry in entries]
        rows = [(zlib.crc32(text.encode()), text) for text in texts]
        with self._explained():
            self._file.execute("BEGIN")
            self._file.executemany("INSERT INTO entries (checksum, entry) VALUES (?, ?)", rows)
            self._file.execute("COMMIT")

    def remove(self) -> None:
        """Remove the file: what is made from it has been written."""
        self._file.close()
        self.path.unlink(missing_ok=True)

    def __enter__(self) -> "Journal":
        """Return this."""
        return self

    def __exit__(self, *error: object) -> None:
        """Close the file."""
        self._file.close()

    def _check(self, digest: str, *, restart: bool) -> None:
        """Read the entries; HarnessError unless they belong to this work."""
        (application,) = self._file.execute("PRAGMA application_id").fetchone()
        if application != APPLICATION:
            raise self._is_none()
        ((work, of),) = self._file.execute("SELECT kind, digest FROM work")
        if work != self._work:
            raise self._is_none()
        if restart:
            return
        if of != digest:
            raise HarnessError(
                f"{self.path}: is of another {self._work}, another FMU or another version; "
                f"{self._remedy}"
            )
        for number, checksum, text in self._file.execute("SELECT * FROM entries ORDER BY number"):
            if isinstance(text, str) and zlib.crc32(text.encode()) == checksum:
                self.entries[number] = json.loads(text)
            else:
                self.damaged.append(number)
        self._file.executemany("DELETE FROM entries WHERE number = ?", [(n,) for n in self.damaged])

    def _is_none(self) -> HarnessError:
        return HarnessError(
            f"{self.path}: is no journal of a {self._work}, or damaged; move the file away"
        )

    @contextmanager
    def _explained(self) -> Iterator[None]:
        """Turn errors of the file into a HarnessError that names it."""
        try:
            yield
        except OSError as error:
            raise HarnessError(f"{self.path}: cannot be written: {error.strerror}") from error
        except sqlite3.OperationalError as error:
            if error.sqlite_errorcode in (sqlite3.SQLITE_BUSY, sqlite3.SQLITE_LOCKED):
                raise HarnessError(f"{self.path}: another {self._work} is writing it") from error
            raise HarnessError(f"{self.path}: cannot be written: {error}") from error
        except (sqlite3.Error, ValueError) as error:
            raise self._is_none() from error
