"""Files that are written, whole, and journals; where they may be."""

import errno
import os
import sqlite3
import stat
import sys
from contextlib import closing
from math import inf
from pathlib import Path

import pytest

from slider_resonator.errors import HarnessError
from slider_resonator.output import files
from slider_resonator.output.files import distinct, make_folder, replacing, writable, write_marked
from slider_resonator.output.journal import Journal


def test_the_file_appears_whole_with_usual_rights(tmp_path: Path) -> None:
    path = tmp_path / "out.csv"
    with replacing(path) as temporary:
        temporary.write_text("done")
        assert not path.exists()
    assert path.read_text() == "done"
    assert stat.S_IMODE(path.stat().st_mode) & 0o400
    assert [p.name for p in path.parent.iterdir()] == ["out.csv"], "no temporary file stays behind"


def test_a_failure_keeps_the_old_file(tmp_path: Path) -> None:
    path = tmp_path / "out.csv"
    path.write_text("old")
    with pytest.raises(ZeroDivisionError), replacing(path) as temporary:
        temporary.write_text(f"half {1 / 0}")
    assert path.read_text() == "old"
    assert [p.name for p in tmp_path.iterdir()] == ["out.csv"]


@pytest.mark.parametrize(
    ("target", "written", "said"),
    [
        ("file/x", "ours", "file/x: cannot be written: Not a directory"),
        ("no/x", "ours", "no/x: cannot be written: No such file"),
        ("folder", "ours", "folder: cannot be written: Is a directory"),
        ("x", "/dev/full", "x: cannot be written: No space left"),
    ],
)
def test_a_write_that_fails_is_named(tmp_path: Path, target: str, written: str, said: str) -> None:
    (tmp_path / "file").touch()
    (tmp_path / "folder").mkdir()
    with pytest.raises(HarnessError, match=said), replacing(tmp_path / target) as temporary:
        (temporary if written == "ours" else Path(written)).write_text("done")
    assert sorted(p.name for p in tmp_path.iterdir()) == ["file", "folder"]


@pytest.mark.parametrize(
    ("target", "refused"),
    [
        ("pipe", "is a link, a pipe or a device; must be a regular file"),
        ("link", "is a link, a pipe or a device; must be a regular file"),
        ("folder", "is a directory; must be a regular file"),
        ("file/out.csv", "Not a directory"),
        ("x" * 300, "name too long"),
    ],
)
def test_what_cannot_be_written_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, target: str, refused: str
) -> None:
    monkeypatch.chdir(tmp_path)
    os.mkfifo("pipe")
    Path("folder").mkdir()
    Path("link").symlink_to("elsewhere")
    Path("file").touch()
    with pytest.raises(HarnessError, match=refused):
        writable(target)
    assert writable("p.PNG", (".png",)).name == "p.PNG"


def test_read_only_folder_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert writable(str(tmp_path / "out.csv")).name == "out.csv"
    assert not list(tmp_path.iterdir()), "trying leaves nothing behind"

    def read_only(*_: object, **__: object) -> None:
        raise OSError(errno.EROFS, os.strerror(errno.EROFS))

    monkeypatch.setattr(files, "TemporaryFile", read_only)
    with pytest.raises(HarnessError, match="cannot be written to: Read-only file system"):
        writable(str(tmp_path / "out.csv"))


def test_a_folder_for_results_is_made_unless_a_file_is_there(tmp_path: Path) -> None:
    for _ in range(2):
        make_folder(tmp_path / "paper" / "results")
        assert (tmp_path / "paper" / "results").is_dir()
    (tmp_path / "file").touch()
    for folder in ("file", "file/results"):
        with pytest.raises(HarnessError, match=f"{folder}: cannot be made a folder"):
            make_folder(tmp_path / folder)


def test_target_that_is_read_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    fmu = tmp_path / "my.fmu"
    fmu.touch()
    os.link(fmu, tmp_path / "second_name")
    for target in (fmu, Path("my.fmu"), Path("second_name")):
        with pytest.raises(HarnessError, match=r"--out .* is the FMU"):
            distinct({"--out": target}, {"the FMU": fmu})


def test_targets_must_differ(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(HarnessError, match=r"--plot .* is the file of --out"):
        distinct({"--out": Path("a.png"), "--plot": tmp_path / "a.png"}, {})
    distinct({"--out": Path("a.csv"), "--plot": Path("a.png")}, {"the FMU": Path("my.fmu")})
    distinct({"--out": None, "--plot": None}, {})


BEGIN, END = "<!-- part -->", "<!-- end of part -->"


def test_what_is_around_marks_stays(tmp_path: Path) -> None:
    path = tmp_path / "README.md"
    write_marked(path, "the text", BEGIN, END)
    assert path.read_text() == "the text\n"
    path.write_text(f"before\n{BEGIN}\nold\n{END}\nafter\n")
    write_marked(path, "new", BEGIN, END)
    assert path.read_text() == f"before\n{BEGIN}\nnew\n{END}\nafter\n"


@pytest.mark.parametrize("text", [BEGIN, END, END + BEGIN, BEGIN + END + BEGIN])
def test_marks_that_are_no_pair_are_refused(tmp_path: Path, text: str) -> None:
    path = tmp_path / "README.md"
    path.write_text(text)
    with pytest.raises(HarnessError, match="must have one"):
        write_marked(path, "new", BEGIN, END)
    assert path.read_text() == text


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
    with pytest.raises(HarnessError, match="journal: a journal of a sweep; must be"):
        Journal(path, "mutation run", "a", "move the file away", restart=True)
    assert path.read_bytes() == content
    with opened(path, "b", restart=True) as journal:
        assert journal.entries == []


@pytest.mark.parametrize("restart", [False, True])
def test_two_at_once_are_refused(restart: bool, path: Path) -> None:
    with opened(path), pytest.raises(HarnessError, match="journal: database is locked"):
        opened(path, restart=restart)
    assert found(path) == ENTRIES


def test_a_folder_that_is_not_there_is_named(tmp_path: Path) -> None:
    with pytest.raises(HarnessError, match="none/journal: cannot be used as a journal"):
        opened(tmp_path / "none" / "journal")
    with pytest.raises(HarnessError, match="cannot be used as a journal: Is a directory"):
        opened(tmp_path)


@pytest.mark.parametrize("restart", [False, True])
def test_a_file_that_is_no_journal_is_left_alone(path: Path, restart: bool) -> None:
    other = path.with_name("other")
    with closing(sqlite3.connect(other)) as database, database:
        database.execute("CREATE TABLE work (kind, digest)")
    cut_off = path.read_bytes()[:5000]
    for content in (b"Monday: measured", b"\x00\xff\n", b"SQLite", other.read_bytes(), cut_off):
        path.write_bytes(content)
        with pytest.raises(HarnessError, match="cannot be used as a journal"):
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
            with pytest.raises(HarnessError, match="cannot be used as a journal: disk I/O error"):
                journal.add(["x" * 100_000])
        finally:
            resource.setrlimit(resource.RLIMIT_FSIZE, before)
