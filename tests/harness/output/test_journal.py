import sqlite3
import sys
from contextlib import closing
from math import inf
from pathlib import Path

import pytest

from slider_resonator.errors import HarnessError
from slider_resonator.output.journal import Journal

ENTRIES = [[0, [0.1 + 0.2, "steady"], None], [1, [None, None], "load = nan"], [2, [inf], "\u00e9"]]


def opened(path: Path, digest: str = "a", *, restart: bool = False) -> Journal:
    return Journal(path, "sweep", digest, "discard it with --restart", restart=restart)


def found(path: Path) -> list[object]:
    with opened(path) as journal:
        return journal.entries


@pytest.fixture
def path(tmp_path: Path) -> Path:
    path = tmp_path / "journal"
    with opened(path) as journal:
        journal.add(ENTRIES[:1])
        journal.add(ENTRIES[1:])
    return path


def test_entries_come_back_to_the_last_digit_and_alone(path: Path) -> None:
    assert found(path) == ENTRIES
    assert [one.name for one in path.parent.iterdir()] == ["journal"]


def test_the_journal_of_other_work_is_refused_and_left_alone(path: Path) -> None:
    content = path.read_bytes()
    with pytest.raises(HarnessError, match=r"another sweep.*--restart"):
        opened(path, "b")
    with pytest.raises(HarnessError, match="is no journal of a mutation run"):
        Journal(path, "mutation run", "a", "move the file away", restart=True)
    assert path.read_bytes() == content
    with opened(path, "b", restart=True) as journal:
        assert journal.entries == []


@pytest.mark.parametrize("restart", [False, True])
def test_two_at_once_are_refused(restart: bool, path: Path) -> None:
    with opened(path), pytest.raises(HarnessError, match="another sweep is writing it"):
        opened(path, restart=restart)
    assert found(path) == ENTRIES


def test_a_folder_that_is_not_there_is_named(tmp_path: Path) -> None:
    with pytest.raises(HarnessError, match="none/journal: cannot be written"):
        opened(tmp_path / "none" / "journal")
    with pytest.raises(HarnessError, match="cannot be written: Is a directory"):
        opened(tmp_path)


@pytest.mark.parametrize("restart", [False, True])
def test_a_file_that_is_no_journal_is_left_alone(path: Path, restart: bool) -> None:
    other = path.with_name("other")
    with closing(sqlite3.connect(other)) as database, database:
        database.execute("CREATE TABLE work (kind, digest)")
    cut_off = path.read_bytes()[:5000]
    for content in (b"Monday: measured", b"\x00\xff\n", b"SQLite", other.read_bytes(), cut_off):
        path.write_bytes(content)
        with pytest.raises(HarnessError, match="is no journal of a sweep, or damaged"):
            opened(path, restart=restart)
        assert path.read_bytes() == content
    path.write_bytes(b"")
    assert found(path) == []


@pytest.mark.skipif(sys.platform == "win32", reason="no limit on files, which stands for the disk")
def test_a_full_disk_is_named(path: Path) -> None:
    import resource

    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    with opened(path) as journal:
        try:
            resource.setrlimit(resource.RLIMIT_FSIZE, (path.stat().st_size + 10, before[1]))
            with pytest.raises(HarnessError, match="journal: cannot be written"):
                journal.add(["x" * 100_000])
        finally:
            resource.setrlimit(resource.RLIMIT_FSIZE, before)
