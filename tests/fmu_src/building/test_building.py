"""Parts of a build: archive, cache, content, dates, platforms."""

import itertools
import platform
import struct
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from fmu_src.building.archive import write_archive
from fmu_src.building.build_error import BuildError
from fmu_src.building.build_folder import build_folder
from fmu_src.building.cache import cache_folder, cached
from fmu_src.building.compiling import Compiler, compile_binary
from fmu_src.building.content import digest_of
from fmu_src.building.dates import date_of_build, date_text
from fmu_src.building.platforms import (
    AARCH64_LINUX,
    HOST,
    PLATFORMS,
    Platform,
    host_platform,
    platforms_named,
)
from fmu_src.building.universal_binary import universal_binary
from fmu_src.compare import main

FILES = {"b/two": b"2", "a": b"1" * 1000}


def test_an_older_file_is_replaced_or_stays(tmp_path: Path) -> None:
    older = write_archive(tmp_path, "Model", {"a": b"old"}).read_bytes()
    with pytest.raises(TypeError):
        write_archive(tmp_path, "Model", {"a": None})  # type: ignore[dict-item]
    assert (tmp_path / "Model.fmu").read_bytes() == older
    assert write_archive(tmp_path, "Model", FILES).read_bytes() != older
    assert [p.name for p in tmp_path.iterdir()] == ["Model.fmu"], "no left-overs"


@pytest.fixture
def make() -> Callable[[], bytes]:
    """Makes another content each time, which counts."""
    numbers = itertools.count(1)
    return lambda: b"binary %d" % next(numbers)


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("HOME", str(tmp_path))
    found = cache_folder()
    assert found is not None
    return found


@pytest.fixture
def no_home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "file").touch()
    monkeypatch.setenv("HOME", str(tmp_path / "file"))
    assert cache_folder() is None


@pytest.mark.usefixtures("folder")
def test_equal_origins_are_made_once(make: Callable[[], bytes]) -> None:
    assert cached("library.so", b"sources", make) == b"binary 1"
    assert cached("library.so", b"sources", make) == b"binary 1"
    assert cached("library.dll", b"sources", make) == b"binary 2"
    assert cached("library.so", b"other sources", make) == b"binary 3"
    assert cached("library.so", b"sources", make) == b"binary 1"


@pytest.mark.parametrize(
    "damage", [lambda kept: kept[:-1], lambda kept: kept[:-1] + b"x", lambda kept: b""]
)
def test_what_is_damaged_is_made_again(
    folder: Path, make: Callable[[], bytes], damage: Callable[[bytes], bytes]
) -> None:
    cached("library.so", b"sources", make)
    (path,) = folder.glob("library.so.*.made")
    path.write_bytes(damage(path.read_bytes()))
    assert cached("library.so", b"sources", make) == b"binary 2"


@pytest.mark.usefixtures("no_home")
def test_without_a_home_all_is_made_again(make: Callable[[], bytes]) -> None:
    assert [cached("library.so", b"sources", make) for _ in range(2)] == [b"binary 1", b"binary 2"]


SOURCES = {"a.c": "int a;\n", "b.c": "int b;\n", "b.h": "extern int b;\n"}


def content(folder: Path) -> dict[str, str]:
    return {path.name: path.read_text(encoding="utf-8") for path in folder.iterdir()}


@pytest.mark.skipif(sys.platform == "win32", reason="its builds use new folders")
@pytest.mark.usefixtures("folder")
def test_what_is_the_same_keeps_place_and_time() -> None:
    """Builds compile what has changed since the last one."""
    with build_folder("some-target", SOURCES) as first:
        assert content(first) == SOURCES
        (first / "library.so").touch()
        times = {path.name: path.stat().st_mtime_ns for path in first.iterdir()}
    changed = {"a.c": SOURCES["a.c"], "b.c": "int b = 1;\n", "c.c": "int c;\n"}
    with build_folder("some-target", changed) as second:
        assert second == first
        assert content(second) == changed, "nothing is left of the build before"
        assert (second / "a.c").stat().st_mtime_ns == times["a.c"]
        assert (second / "b.c").stat().st_mtime_ns != times["b.c"]


@pytest.mark.usefixtures("no_home")
@pytest.mark.parametrize("target", ["some-target", None])
def test_without_a_place_for_a_cache_the_folder_is_temporary(target: str | None) -> None:
    with build_folder(target, SOURCES) as folder:
        assert content(folder) == SOURCES
    assert not folder.exists()


@pytest.mark.usefixtures("folder")
def test_a_failure_is_not_kept() -> None:
    compiler = Compiler(("false",), "no compiler", crosses=True)
    for _ in range(2):
        with pytest.raises(BuildError, match="no compiler could not compile for some-target"):
            compile_binary({"a.c": "int a;\n"}, "a.so", "some-target", [], compiler)


CONTENT = {"a": b"1", "b": b"2"}


@pytest.mark.parametrize(
    "other", [{"a": b"1"}, {"a": b"1", "b": b"3"}, {"a": b"1", "c": b"2"}, {"a": b"1b", "": b"2"}]
)
def test_whatever_differs_gives_another_digest(other: dict[str, bytes]) -> None:
    assert digest_of(other) != digest_of(CONTENT)


@pytest.mark.parametrize(
    ("seconds", "text"),
    {
        None: "1980-01-01T00:00:00Z",
        "0": "1970-01-01T00:00:00Z",
        "1700000000": "2023-11-14T22:13:20Z",
    }.items(),
)
def test_the_date_is_never_that_of_the_build(
    monkeypatch: pytest.MonkeyPatch, seconds: str | None, text: str
) -> None:
    monkeypatch.delenv("SOURCE_DATE_EPOCH", raising=False)
    if seconds is not None:
        monkeypatch.setenv("SOURCE_DATE_EPOCH", seconds)
    assert date_text(date_of_build()) == text


@pytest.mark.parametrize("seconds", ["", "now", "1.5", "1e9", "-1", "1" * 40])
def test_invalid_dates_are_refused(monkeypatch: pytest.MonkeyPatch, seconds: str) -> None:
    monkeypatch.setenv("SOURCE_DATE_EPOCH", seconds)
    with pytest.raises(BuildError, match=f"SOURCE_DATE_EPOCH = '{seconds}' refused: must be"):
        date_of_build()


def test_an_unknown_platform_is_refused_by_name() -> None:
    assert platforms_named([], "3.0") == [*PLATFORMS.values(), AARCH64_LINUX]
    for unknown in ("aarch64-linux", "amiga"):
        with pytest.raises(BuildError, match=f"'{unknown}' refused: must be one of linux64, win64"):
            platforms_named(["linux64", unknown])


@pytest.mark.parametrize(
    ("system", "machine", "found"),
    [
        ("linux", "x86_64", PLATFORMS["linux64"]),
        ("win32", "AMD64", PLATFORMS["win64"]),
        ("darwin", "arm64", PLATFORMS["darwin64"]),
        ("darwin", "x86_64", PLATFORMS["darwin64"]),
        ("linux", "aarch64", AARCH64_LINUX),
        ("linux", "arm64", AARCH64_LINUX),
        ("sunos5", "sun4u", None),
        ("win32", "x86", None),
    ],
)
def test_the_host_is_recognised_or_refused(
    monkeypatch: pytest.MonkeyPatch, system: str, machine: str, found: Platform | None
) -> None:
    """ARM has a name in FMI 3.0 only."""
    monkeypatch.setattr(sys, "platform", system)
    monkeypatch.setattr(platform, "machine", lambda: machine)
    if found in PLATFORMS.values():
        assert [host_platform()] == platforms_named([HOST]) == [found]
        return
    with pytest.raises(BuildError, match=f"no name for {system} on {machine}"):
        host_platform()
    if found:
        assert host_platform("3.0") == found


def test_every_library_is_at_its_offset_in_the_header() -> None:
    libraries = {
        processor: struct.pack("<III", 0xFEEDFACF, processor, 3).ljust(size, b"x")
        for processor, size in ((0x01000007, 20_000), (0x0100000C, 70_001))
    }
    data = universal_binary([*libraries.values()])
    assert struct.unpack_from(">II", data) == (0xCAFEBABE, 2), "the header is big-endian"
    for k, (processor, library) in enumerate(libraries.items()):
        *found, offset, size, alignment = struct.unpack_from(">IIIII", data, 8 + 20 * k)
        assert found == [processor, 3]
        assert data[offset : offset + size] == library
        assert offset % (1 << alignment) == 0, "a library begins on a page"
    with pytest.raises(ValueError, match="begins with 0x464c457f: must be 0xfeedfacf"):
        universal_binary([b"\x7fELF" + bytes(60)])


def test_files_that_differ_or_are_missing_are_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """As CI compares builds of two platforms; each makes its own binary for macOS."""
    for name, files in {
        "a": {"same": b"1", "other": b"1", "only_here": b"1", "darwin64": b"1"},
        "b": {"same": b"1", "other": b"2", "only_there": b"1", "darwin64": b"2"},
    }.items():
        write_archive(tmp_path, name, files)
    for second, code, printed in (
        ("a", 0, []),
        ("b", 1, [f"a.fmu: {name} differs" for name in ("only_here", "only_there", "other")]),
    ):
        both = [str(tmp_path / f"{name}.fmu") for name in ("a", second)]
        monkeypatch.setattr(sys, "argv", ["compare", *both])
        assert main() == code
        assert capsys.readouterr().out.splitlines() == printed
