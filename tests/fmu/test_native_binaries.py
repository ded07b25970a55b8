"""The binaries inside the native FMU: what they show, what they need, how large they are.

Those for other platforms are compiled in `make interop`.
"""

import os
import re
import subprocess
import zipfile
from pathlib import Path

import pytest

from fmu_src.building.c_sources import slider_sources, write_sources
from fmu_src.building.compiling import FLAGS, default_compiler
from fmu_src.building.native_fmu import build_native
from fmu_src.building.platforms import PLATFORMS
from tests.fmu.binary_files import elf_exports, mach_libraries, pe_exports

MEGABYTE = 1_000_000
X86_64, ARM64 = 0x01000007, 0x0100000C
# zig's linker puts these addresses of the library itself into every library for macOS.
MARKS_OF_THE_LINKER = {"__dso_handle", "_mh_dylib_header"}
LINUX, WINDOWS, MACOS = (PLATFORMS[n] for n in ("linux64", "win64", "darwin64"))
MODEL = "SliderResonator"


def fmi_functions() -> set[str]:
    """All functions of the standard, those of model exchange too, by its header."""
    header = slider_sources()["fmi/fmi2Functions.h"]
    return set(re.findall(r"FMI2_Export +(?:fmi2\w+TYPE) +(fmi2\w+);", header))


@pytest.fixture(scope="session")
def complete_fmu(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The native FMU for every platform."""
    return build_native(tmp_path_factory.mktemp("complete"))


@pytest.fixture(scope="session")
def linux_binary(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    """That for Linux, which any machine builds quickly."""
    fmu = build_native(tmp_path_factory.mktemp("linux"), platforms=[LINUX.name])
    with zipfile.ZipFile(fmu) as archive:
        return archive.read(LINUX.binary(MODEL))


@pytest.fixture(scope="session")
def binaries(complete_fmu: Path) -> dict[str, bytes]:
    with zipfile.ZipFile(complete_fmu) as archive:
        names = [n for n in archive.namelist() if n.startswith("binaries/")]
        return {n: archive.read(n) for n in names}


@pytest.mark.interop
def test_platforms(binaries: dict[str, bytes]) -> None:
    assert sorted(binaries) == [
        "binaries/darwin64/SliderResonator.dylib",
        "binaries/linux64/SliderResonator.so",
        "binaries/win64/SliderResonator.dll",
    ]


def test_linux_exports(linux_binary: bytes) -> None:
    assert elf_exports(linux_binary) == fmi_functions(), "nothing but FMI is shown"


def test_linux_needs(linux_binary: bytes) -> None:
    """The versions of symbols that it needs of others are texts in it, such as GLIBC_2.2.5."""
    versions = re.findall(rb"\0([A-Z]+)_(\d[\d.]*)(?=\0)", linux_binary)
    assert {name for name, _ in versions} == {b"GLIBC"}
    newest = max(tuple(map(int, version.split(b"."))) for _, version in versions)
    assert newest <= (2, 17), f"needs {newest}: Linux distributions since 2014 are to load it"


@pytest.mark.slow
def test_the_prefix_for_static_linking_is_that_of_the_host(tmp_path: Path) -> None:
    write_sources(slider_sources(), tmp_path)
    command = [*default_compiler().command, "-target", LINUX.targets[0], *FLAGS]
    command += ["-fvisibility=default", "-DFMI2_FUNCTION_PREFIX=Slider_", "-o", "prefixed.so"]
    command += [*map(str, tmp_path.rglob("*.c")), "-lm"]
    subprocess.run(command, cwd=tmp_path, check=True)
    exports = elf_exports((tmp_path / "prefixed.so").read_bytes())
    found = {name for name in exports if "fmi2" in name}
    assert found == {f"Slider_{name}" for name in fmi_functions()}


@pytest.mark.interop
def test_windows_exports(binaries: dict[str, bytes]) -> None:
    assert pe_exports(binaries[WINDOWS.binary(MODEL)]) == fmi_functions()


@pytest.mark.interop
def test_macos_libraries(binaries: dict[str, bytes]) -> None:
    libraries = list(mach_libraries(binaries[MACOS.binary(MODEL)]))
    assert [x.processor for x in libraries] == [X86_64, ARM64]
    for library in libraries:
        assert library.exports - MARKS_OF_THE_LINKER == fmi_functions()
        assert library.own_name == "SliderResonator.dylib", "no path of the build"
        assert library.first_system <= (11, 0)


@pytest.mark.interop
def test_size(complete_fmu: Path) -> None:
    assert complete_fmu.stat().st_size < MEGABYTE


@pytest.mark.interop
def test_no_path_of_the_build_is_inside(binaries: dict[str, bytes]) -> None:
    for name, data in binaries.items():
        found = [t for t in (b"/tmp/", os.fsencode(Path.home()), b".pdb") if t in data]
        assert found == [], name


@pytest.mark.interop
def test_a_quick_build_is_the_same_build(complete_fmu: Path, native_fmu: Path) -> None:
    """A state that one wrote is one that the other reads."""
    with zipfile.ZipFile(complete_fmu) as complete, zipfile.ZipFile(native_fmu) as quick:
        for name in quick.namelist():
            assert quick.read(name) == complete.read(name), name
