from __future__ import annotations

from math import inf
from pathlib import Path

import pytest

from slider_resonator.errors import HarnessError
from slider_resonator.sweeping.measures import Row
from slider_resonator.sweeping.table import journal_path, open_journal, rows_of

ROWS: list[Row] = [
    (0, [0.1 + 0.2, "steady"], None),
    (1, [None, None], "load = nan"),
    (2, [inf], None),
]


def test_rows_come_back_from_the_journal_beside_the_table(tmp_path: Path) -> None:
    table = tmp_path / "b.csv"
    with open_journal(table, "a") as journal:
        journal.add([ROWS[:1], ROWS[1:]])
    assert journal_path(table) == tmp_path / "b.csv.journal"
    with open_journal(table, "a") as journal:
        assert rows_of(journal) == {row[0]: row for row in ROWS}


def test_the_journal_of_another_sweep_names_the_remedy(tmp_path: Path) -> None:
    with open_journal(tmp_path / "b.csv", "a"):
        pass
    with pytest.raises(HarnessError, match=r"another sweep.*--restart"):
        open_journal(tmp_path / "b.csv", "b")


def test_a_line_that_is_no_point_is_named(tmp_path: Path) -> None:
    with open_journal(tmp_path / "b.csv", "a") as journal:
        journal.add([ROWS, [{"point": 3}]])
    with (
        open_journal(tmp_path / "b.csv", "a") as journal,
        pytest.raises(HarnessError, match=r"journal entry 2: is no point of a sweep"),
    ):
        rows_of(journal)
