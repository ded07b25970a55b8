from __future__ import annotations

import errno
import os
from pathlib import Path

import pytest

from slider_resonator.errors import HarnessError
from slider_resonator.output import targets
from slider_resonator.output.targets import distinct, make_folder, writable


def test_a_new_file_and_a_regular_one_are_allowed(tmp_path: Path) -> None:
    path = tmp_path / "out.csv"
    assert writable(str(path)) == path
    path.write_text("old")
    assert writable(str(path)) == path
    assert path.read_text() == "old", "judging must not touch it"


def test_targets_that_are_not_regular_files_are_refused_by_kind(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")
    (tmp_path / "link").symlink_to(tmp_path / "elsewhere")
    for target, kind in (
        (tmp_path, "a directory"),
        (tmp_path / "pipe", "a pipe"),
        (tmp_path / "link", "a symbolic link"),
        (Path("/dev/null"), "a device"),
    ):
        with pytest.raises(HarnessError, match=f"is {kind}; must be a regular file"):
            writable(str(target))


def test_no_name_and_no_folder_are_refused(tmp_path: Path) -> None:
    with pytest.raises(HarnessError, match="names no file"):
        writable("")
    with pytest.raises(HarnessError, match=r"there is no folder .*missing"):
        writable(str(tmp_path / "missing" / "out.csv"))
    assert not (tmp_path / "missing").exists()
    (tmp_path / "file").touch()
    with pytest.raises(HarnessError, match="Not a directory"):
        writable(str(tmp_path / "file" / "out.csv"))
    with pytest.raises(HarnessError, match="name too long"):
        writable(str(tmp_path / ("x" * 300)))


def test_a_folder_that_cannot_be_written_to_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(os, "access", lambda path, mode: False)  # root may write everywhere
    with pytest.raises(HarnessError, match="cannot be written to"):
        writable(str(tmp_path / "out.csv"))


def test_a_folder_in_which_no_file_can_be_created_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert writable(str(tmp_path / "out.csv")).name == "out.csv"
    assert not list(tmp_path.iterdir()), "trying leaves nothing behind"

    def read_only(*_: object, **__: object) -> None:
        raise OSError(errno.EROFS, os.strerror(errno.EROFS))

    monkeypatch.setattr(targets, "TemporaryFile", read_only)
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


def test_a_suffix_that_no_picture_has_is_refused(tmp_path: Path) -> None:
    with pytest.raises(HarnessError, match=r"'\.txt'; must be one of \.png, \.svg"):
        writable(str(tmp_path / "p.txt"), (".png", ".svg"))
    assert writable(str(tmp_path / "p.PNG"), (".png",)).name == "p.PNG"


def test_a_target_that_is_read_from_is_refused_under_any_name(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    fmu = tmp_path / "my.fmu"
    fmu.touch()
    os.link(fmu, tmp_path / "second_name")
    for target in (fmu, Path("my.fmu"), Path("second_name")):
        with pytest.raises(HarnessError, match=r"--out .* is the FMU"):
            distinct({"--out": target}, {"the FMU": fmu})


def test_two_targets_must_differ_even_before_they_exist(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(HarnessError, match=r"--plot .* is the file of --out"):
        distinct({"--out": Path("a.png"), "--plot": tmp_path / "a.png"}, {})
    distinct({"--out": Path("a.csv"), "--plot": Path("a.png")}, {"the FMU": Path("my.fmu")})
    distinct({"--out": None, "--plot": None}, {})
