from __future__ import annotations

import sys
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
        return list(journal.entries.values())


@pytest.fixture
def path(tmp_path: Path) -> Path:
    path = tmp_path / "journal"
    with opened(path) as journal:
        journal.add(ENTRIES[:1])
        journal.add(ENTRIES[1:])
    return path


def test_entries_come_back_to_the_last_digit(path: Path) -> None:
    assert found(path) == ENTRIES


@pytest.mark.parametrize("keep", range(0, 180, 9))
def test_a_file_cut_anywhere_keeps_its_whole_lines_and_goes_on(keep: int, path: Path) -> None:
    content = path.read_bytes()
    path.write_bytes(content[:keep])
    whole = max(0, content[:keep].count(b"\n") - 1)
    with opened(path) as journal:
        assert list(journal.entries.values()) == ENTRIES[:whole]
        journal.add(ENTRIES[whole:])
    assert path.read_bytes() == content


def test_the_journal_of_other_work_is_refused_and_left_alone(path: Path) -> None:
    content = path.read_bytes()
    with pytest.raises(HarnessError, match=r"another sweep.*--restart"):
        opened(path, "b")
    with pytest.raises(HarnessError, match="is no journal of a mutation run"):
        Journal(path, "mutation run", "a", "move the file away")
    assert path.read_bytes() == content


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


def test_a_file_that_is_no_journal_is_left_alone_unless_discarded(path: Path) -> None:
    path.write_text("Monday: measured.\n")
    with pytest.raises(HarnessError, match="is no journal of a sweep"):
        opened(path)
    assert path.read_text() == "Monday: measured.\n"
    with opened(path, restart=True) as journal:
        journal.add(ENTRIES)
    assert found(path) == ENTRIES


@pytest.mark.parametrize("line", [2, 3, 4])
def test_a_flipped_digit_drops_its_line_only_and_is_named(line: int, path: Path) -> None:
    content = path.read_bytes().splitlines(keepends=True)
    flipped = content[line - 1].replace(b"[%d," % (line - 2), b"[7,", 1)
    assert flipped != content[line - 1]
    path.write_bytes(b"".join([*content[: line - 1], flipped, *content[line:]]))
    sound = [entry for entry in ENTRIES if entry[0] != line - 2]
    with opened(path) as journal:
        assert journal.damaged == [line]
        assert list(journal.entries.values()) == sound
        journal.add([ENTRIES[line - 2]])
    with opened(path) as journal:
        assert journal.damaged == []
        assert list(journal.entries.values()) == [*sound, ENTRIES[line - 2]]


@pytest.mark.skipif(sys.platform == "win32", reason="no limit on files, which stands for the disk")
def test_a_full_disk_is_named(path: Path) -> None:
    import resource

    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    with opened(path) as journal:
        try:
            resource.setrlimit(resource.RLIMIT_FSIZE, (path.stat().st_size + 10, before[1]))
            with pytest.raises(HarnessError, match="journal: cannot be written: File too large"):
                journal.add(ENTRIES[1:])
        finally:
            resource.setrlimit(resource.RLIMIT_FSIZE, before)
