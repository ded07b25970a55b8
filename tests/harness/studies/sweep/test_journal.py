from __future__ import annotations

import sys
from math import inf
from pathlib import Path

import pytest

from slider_resonator.errors import HarnessError
from slider_resonator.studies.sweep.journal import Journal, _line, journal_path
from slider_resonator.studies.sweep.worker import Row

ROWS: list[Row] = [
    (0, [0.1 + 0.2, "steady"], None),
    (1, [None, None], "load = nan"),
    (2, [inf], None),
]


def test_rows_come_back_to_the_last_digit(tmp_path: Path) -> None:
    path = tmp_path / "journal"
    with Journal(path, "a") as journal:
        journal.add(ROWS[:1])
        journal.add(ROWS[1:])
    with Journal(path, "a") as journal:
        assert list(journal.rows.values()) == ROWS


@pytest.mark.parametrize("keep", range(0, 180, 9))
def test_a_file_cut_anywhere_keeps_its_whole_lines_and_goes_on(keep: int, tmp_path: Path) -> None:
    path = tmp_path / "journal"
    with Journal(path, "a") as journal:
        journal.add(ROWS)
    content = path.read_bytes()
    path.write_bytes(content[:keep])
    whole = max(0, content[:keep].count(b"\n") - 1)
    with Journal(path, "a") as journal:
        assert list(journal.rows.values()) == ROWS[:whole]
        journal.add(ROWS[whole:])
    assert path.read_bytes() == content


def test_the_journal_of_another_sweep_is_refused_and_left_alone(tmp_path: Path) -> None:
    path = tmp_path / "journal"
    with Journal(path, "a") as journal:
        journal.add(ROWS)
    content = path.read_bytes()
    with pytest.raises(HarnessError, match=r"another sweep.*--restart"):
        Journal(path, "b")
    assert path.read_bytes() == content


@pytest.mark.parametrize("restart", [False, True])
def test_two_at_once_are_refused(restart: bool, tmp_path: Path) -> None:
    path = tmp_path / "journal"
    with Journal(path, "a") as journal:
        journal.add(ROWS)
        with pytest.raises(HarnessError, match="another sweep is writing it"):
            Journal(path, "a", restart=restart)
    with Journal(path, "a") as journal:
        assert list(journal.rows.values()) == ROWS


def test_a_folder_that_is_not_there_is_named(tmp_path: Path) -> None:
    with pytest.raises(HarnessError, match="cannot be written"):
        Journal(tmp_path / "none" / "journal", "a")


def test_the_journal_is_beside_its_table() -> None:
    assert journal_path(Path("a") / "b.csv") == Path("a") / "b.csv.journal"


def test_a_file_that_is_no_journal_is_left_alone_unless_discarded(tmp_path: Path) -> None:
    path = tmp_path / "journal"
    path.write_text("Monday: measured.\n")
    with pytest.raises(HarnessError, match="is no journal of a sweep"):
        Journal(path, "a")
    assert path.read_text() == "Monday: measured.\n"
    with Journal(path, "a", restart=True) as journal:
        journal.add(ROWS)
    with Journal(path, "a") as journal:
        assert list(journal.rows.values()) == ROWS


@pytest.mark.parametrize("line", [2, 3, 4])
def test_a_flipped_digit_drops_its_line_only_and_is_named(line: int, tmp_path: Path) -> None:
    path = tmp_path / "journal"
    with Journal(path, "a") as journal:
        journal.add(ROWS)
    content = path.read_bytes().splitlines(keepends=True)
    flipped = content[line - 1].replace(b"[%d," % (line - 2), b"[7,", 1)
    assert flipped != content[line - 1]
    path.write_bytes(b"".join([*content[: line - 1], flipped, *content[line:]]))
    with Journal(path, "a") as journal:
        assert journal.damaged == [line]
        sound = [row for row in ROWS if row[0] != line - 2]
        assert list(journal.rows.values()) == sound
        journal.add([ROWS[line - 2]])
    with Journal(path, "a") as journal:
        assert journal.damaged == []
        assert sorted(journal.rows) == [0, 1, 2]


def test_a_line_that_is_no_point_is_named(tmp_path: Path) -> None:
    path = tmp_path / "journal"
    with Journal(path, "a") as journal:
        journal.add(ROWS)
    with path.open("a", encoding="utf-8") as file:
        file.write(_line({"point": 3}))
    with pytest.raises(HarnessError, match=r"journal line 5: is no point of a sweep"):
        Journal(path, "a")


@pytest.mark.skipif(sys.platform == "win32", reason="no limit on files, which stands for the disk")
def test_a_full_disk_is_named(tmp_path: Path) -> None:
    import resource

    path = tmp_path / "journal"
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    with Journal(path, "a") as journal:
        journal.add(ROWS[:1])
        try:
            resource.setrlimit(resource.RLIMIT_FSIZE, (path.stat().st_size + 10, before[1]))
            with pytest.raises(HarnessError, match="journal: cannot be written: File too large"):
                journal.add(ROWS[1:])
        finally:
            resource.setrlimit(resource.RLIMIT_FSIZE, before)
