"""Builds compile what has changed since the last one."""

import sys
from pathlib import Path

import pytest

from fmu_src.building.build_folder import build_folder

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="its builds use new folders")

TARGET = "some-target"
SOURCES = {"a.c": "int a;\n", "b.c": "int b;\n", "b.h": "extern int b;\n"}


def content(folder: Path) -> dict[str, str]:
    return {path.name: path.read_text(encoding="utf-8") for path in folder.iterdir()}


def test_what_is_the_same_keeps_place_and_time(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("HOME", str(tmp_path))
    with build_folder(TARGET, SOURCES) as first:
        assert content(first) == SOURCES
        (first / "library.so").touch()
        times = {path.name: path.stat().st_mtime_ns for path in first.iterdir()}
    changed = {"a.c": SOURCES["a.c"], "b.c": "int b = 1;\n", "c.c": "int c;\n"}
    with build_folder(TARGET, changed) as second:
        assert second == first
        assert content(second) == changed, "nothing is left of the build before"
        assert (second / "a.c").stat().st_mtime_ns == times["a.c"]
        assert (second / "b.c").stat().st_mtime_ns != times["b.c"]


def test_without_a_place_for_a_cache_the_folder_is_temporary(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    nowhere = tmp_path / "file"
    nowhere.touch()
    monkeypatch.setenv("HOME", str(nowhere))
    for target in (TARGET, None):
        with build_folder(target, SOURCES) as folder:
            assert content(folder) == SOURCES
        assert not folder.exists()
