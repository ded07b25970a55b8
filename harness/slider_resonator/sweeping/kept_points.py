"""The finished points of a sweep, in a journal beside its table until that is written."""

from __future__ import annotations

from pathlib import Path

from slider_resonator.errors import HarnessError
from slider_resonator.output.journal import Journal
from slider_resonator.sweeping.worker import Row


def journal_path(table: Path) -> Path:
    """Return where the journal of a table is."""
    return table.with_name(f"{table.name}.journal")


def open_journal(table: Path, digest: str, *, restart: bool = False) -> Journal:
    """Open the journal of a table, whose entries are lists of rows.

    Raises HarnessError as `Journal` does.
    """
    remedy = "move the file away, or discard it with --restart"
    return Journal(journal_path(table), "sweep", digest, remedy, restart=restart)


def rows_of(journal: Journal) -> dict[int, Row]:
    """Return the rows by number of the point; HarnessError for an entry that is none."""
    rows: dict[int, Row] = {}
    for number, entry in journal.entries.items():
        for row in entry if isinstance(entry, list) else [entry]:
            match row:
                case [int(point), list(cells), None | str() as failure]:
                    rows[point] = (point, cells, failure)
                case _:
                    raise HarnessError(
                        f"{journal.path} entry {number}: is no point of a sweep; must be number, "
                        "results and error; --restart discards the file"
                    )
    return rows
