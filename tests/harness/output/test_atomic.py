from __future__ import annotations

import stat
from pathlib import Path

import pytest

from slider_resonator.errors import HarnessError
from slider_resonator.output.atomic import replacing


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


def test_a_place_that_cannot_be_written_is_named(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(HarnessError, match="cannot be written"), replacing(tmp_path / "file" / "x"):
        pass
    with pytest.raises(HarnessError, match="cannot be written"), replacing(tmp_path / "no" / "x"):
        pass
    assert not (tmp_path / "no").exists(), "a folder is not made in passing"


def test_a_place_that_cannot_be_taken_at_the_end_is_named_too(tmp_path: Path) -> None:
    (tmp_path / "folder").mkdir()
    with (
        pytest.raises(HarnessError, match=r"folder: cannot be written: Is a directory"),
        replacing(tmp_path / "folder") as temporary,
    ):
        temporary.write_text("done")
    assert [p.name for p in tmp_path.iterdir()] == ["folder"]


def test_a_write_that_fails_is_an_error_of_the_file(tmp_path: Path) -> None:
    with (
        pytest.raises(HarnessError, match=r"out.csv: cannot be written: No space left"),
        replacing(tmp_path / "out.csv"),
        open("/dev/full", "w") as full,
    ):
        full.write("done")
    assert not list(tmp_path.iterdir())
