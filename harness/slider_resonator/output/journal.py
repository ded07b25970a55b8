"""What long work has finished, kept in a file, so that it can go on after it was stopped."""

import json
import sqlite3
from collections.abc import Iterable, Iterator
from contextlib import AbstractContextManager, ExitStack, contextmanager
from pathlib import Path
from typing import Any

from slider_resonator.errors import HarnessError


class Journal(AbstractContextManager["Journal"]):
    """An SQLite file of entries, which JSON can write, and of the work that they belong to.

    `work` says what is kept, such as "sweep"; `digest` must be another for other work of this kind;
    `remedy` is for messages. `entries` are those found in the file. With `restart` all that it
    holds is discarded. Raises HarnessError for the journal of other work, for a file that is none,
    which stays as it is, and while another process writes it. Use it in a `with` block.
    """

    def __init__(
        self, path: Path, work: str, digest: str, remedy: str, *, restart: bool = False
    ) -> None:
        self.path = path
        self._work = work
        with self._explained(), ExitStack() as on_error:
            with path.open("ab") as file:
                is_new = file.tell() == 0
            self._file = sqlite3.connect(path, timeout=0.0, isolation_level=None)
            on_error.callback(self._file.close)
            # Entries need to survive the end of this process, not that of the machine.
            self._file.execute("PRAGMA synchronous = OFF")
            self._file.execute("PRAGMA locking_mode = EXCLUSIVE")
            self._file.execute("BEGIN EXCLUSIVE")
            if is_new:
                self._file.execute("CREATE TABLE work (kind TEXT, digest TEXT)")
                self._file.execute("CREATE TABLE entries (number INTEGER PRIMARY KEY, entry TEXT)")
                self._file.execute("INSERT INTO work VALUES (?, ?)", (work, digest))
            ((kind, found),) = self._file.execute("SELECT kind, digest FROM work")
            if kind != work:
                raise ValueError(f"a journal of a {kind}")
            if restart:
                self._file.execute("DELETE FROM entries")
                self._file.execute("UPDATE work SET digest = ?", (digest,))
            elif found != digest:
                raise HarnessError(
                    f"{path}: is of another {work}, another FMU or another version; {remedy}"
                )
            rows = self._file.execute("SELECT entry FROM entries ORDER BY number")
            self.entries: list[Any] = [json.loads(entry) for (entry,) in rows]
            self._file.execute("COMMIT")
            on_error.pop_all()

    def add(self, entries: Iterable[object]) -> None:
        """Keep entries; they survive the end of this process."""
        rows = [(json.dumps(entry, separators=(",", ":")),) for entry in entries]
        with self._explained():
            self._file.execute("BEGIN")
            self._file.executemany("INSERT INTO entries (entry) VALUES (?)", rows)
            self._file.execute("COMMIT")

    def remove(self) -> None:
        """Remove the file: what is made from it has been written."""
        self._file.close()
        self.path.unlink(missing_ok=True)

    def __exit__(self, *error: object) -> None:
        """Close the file."""
        self._file.close()

    @contextmanager
    def _explained(self) -> Iterator[None]:
        """Turn errors of the file into a HarnessError that names it."""
        try:
            yield
        except (OSError, sqlite3.Error, ValueError) as error:
            said = error.strerror if isinstance(error, OSError) else error
            raise HarnessError(
                f"{self.path}: cannot be used as a journal: {said}; must be a new file, or one "
                f"that this {self._work} alone writes"
            ) from error
