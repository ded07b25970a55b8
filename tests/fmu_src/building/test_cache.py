"""A build takes what the last one made, where all that it depends on is the same."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from fmu_src.building.build_error import BuildError
from fmu_src.building.cache import KEPT, cache_folder, cached
from fmu_src.building.compiling import Compiler, compile_binary


class Maker:
    """Makes another content each time, and counts."""

    def __init__(self) -> None:
        self.made = 0

    def __call__(self) -> bytes:
        self.made += 1
        return b"binary %d" % self.made


@pytest.fixture
def make() -> Maker:
    return Maker()


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("HOME", str(tmp_path))
    found = cache_folder()
    assert found is not None
    return found


@pytest.mark.usefixtures("folder")
def test_equal_origins_are_made_once(make: Maker) -> None:
    assert cached("library.so", b"sources", make) == b"binary 1"
    assert cached("library.so", b"sources", make) == b"binary 1"
    assert cached("library.dll", b"sources", make) == b"binary 2"
    assert cached("library.so", b"other sources", make) == b"binary 3"
    assert cached("library.so", b"sources", make) == b"binary 1"


def test_the_last_few_of_a_name_are_kept(folder: Path, make: Maker) -> None:
    cached("library", b"another name", make)
    for number in range(KEPT + 1):
        cached("library.so", b"sources %d" % number, make)
    assert len(list(folder.glob("library.so.*.made"))) == KEPT
    assert len(list(folder.glob("library.*.made"))) == KEPT + 1


@pytest.mark.parametrize(
    "damage", [lambda kept: kept[:-1], lambda kept: kept[:-1] + b"x", lambda kept: b""]
)
def test_what_is_damaged_is_made_again(
    folder: Path, make: Maker, damage: Callable[[bytes], bytes]
) -> None:
    cached("library.so", b"sources", make)
    (path,) = folder.glob("library.so.*.made")
    path.write_bytes(damage(path.read_bytes()))
    assert cached("library.so", b"sources", make) == b"binary 2"


def test_without_a_home_all_is_made_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, make: Maker
) -> None:
    (tmp_path / "file").touch()
    monkeypatch.setenv("HOME", str(tmp_path / "file"))
    assert cache_folder() is None
    assert [cached("library.so", b"sources", make) for _ in range(2)] == [b"binary 1", b"binary 2"]


@pytest.mark.usefixtures("folder")
def test_a_failure_is_not_kept() -> None:
    compiler = Compiler(("false",), "no compiler", crosses=True)
    for _ in range(2):
        with pytest.raises(BuildError, match="no compiler could not compile for some-target"):
            compile_binary({"a.c": "int a;\n"}, "a.so", "some-target", [], compiler)
