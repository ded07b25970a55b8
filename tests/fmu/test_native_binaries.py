"""The binaries inside the native FMU: what they show, what they need, how large they are.

Those for other platforms are compiled in `make interop`.
"""

import io
import os
import re
import subprocess
from pathlib import Path

import lief
import pytest

from fmu_src.building.c_sources import FmiVersion, slider_sources, write_sources
from fmu_src.building.compiling import FLAGS, default_compiler
from fmu_src.building.native_fmu import build_native, build_native_3
from fmu_src.building.platforms import PLATFORMS
from studies.mutants.archive import files_in

MEGABYTE = 1_000_000
# zig's linker puts these addresses of the library itself into every library for macOS.
MARKS_OF_THE_LINKER = {"__dso_handle", "_mh_dylib_header"}
LINUX, WINDOWS, MACOS = (PLATFORMS[n] for n in ("linux64", "win64", "darwin64"))
MODEL = "SliderResonator"


def fmi_functions(version: FmiVersion = "2.0") -> set[str]:
    """All functions of the standard, those of other interface types too, by its header."""
    n = version[0]
    header = slider_sources(version)[f"fmi/fmi{n}Functions.h"]
    return set(re.findall(rf"FMI{n}_Export +(?:fmi{n}\w+TYPE) +(fmi{n}\w+);", header))


def elf_exports(data: bytes) -> set[str]:
    """Names of the symbols that a Linux library defines for others."""
    library = lief.ELF.parse(io.BytesIO(data))
    assert library is not None
    return {str(symbol.name) for symbol in library.exported_symbols}


@pytest.fixture(scope="session")
def complete_fmu(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The native FMU for every platform."""
    return build_native(tmp_path_factory.mktemp("complete"))


@pytest.fixture(scope="session")
def binaries(complete_fmu: Path) -> dict[str, bytes]:
    return {n: data for n, data in files_in(complete_fmu).items() if n.startswith("binaries/")}


@pytest.mark.interop
def test_all_platforms_are_small_and_have_no_path_of_the_build(
    complete_fmu: Path, binaries: dict[str, bytes]
) -> None:
    assert complete_fmu.stat().st_size < MEGABYTE
    assert sorted(binaries) == [
        "binaries/darwin64/SliderResonator.dylib",
        "binaries/linux64/SliderResonator.so",
        "binaries/win64/SliderResonator.dll",
    ]
    for name, data in binaries.items():
        found = [t for t in (b"/tmp/", os.fsencode(Path.home()), b".pdb") if t in data]
        assert found == [], name


@pytest.mark.interop
def test_platforms_of_fmi_3(tmp_path: Path) -> None:
    """By the first bytes of each binary, and the processor in those of Linux."""
    files = files_in(build_native_3(tmp_path))
    binaries = {name: data for name, data in files.items() if name.startswith("binaries/")}
    heads = {name: data[:2] + data[18:20] * name.endswith(".so") for name, data in binaries.items()}
    assert heads == {
        "binaries/aarch64-darwin/SliderResonator3.dylib": b"\xcf\xfa",
        "binaries/aarch64-linux/SliderResonator3.so": b"\x7fE\xb7\x00",
        "binaries/x86_64-darwin/SliderResonator3.dylib": b"\xcf\xfa",
        "binaries/x86_64-linux/SliderResonator3.so": b"\x7fE\x3e\x00",
        "binaries/x86_64-windows/SliderResonator3.dll": b"MZ",
    }


@pytest.mark.parametrize("version", ["2.0", "3.0"])
def test_linux_shows_fmi_and_needs_old_systems_only(version: FmiVersion, tmp_path: Path) -> None:
    """The versions of symbols that it needs of others are texts in it, such as GLIBC_2.2.5."""
    build = build_native if version == "2.0" else build_native_3
    files = files_in(build(tmp_path, platforms=[LINUX.name]))
    (data,) = (data for name, data in files.items() if name.endswith(".so"))
    assert elf_exports(data) == fmi_functions(version), "nothing but FMI is shown"
    versions = re.findall(rb"\0([A-Z]+)_(\d[\d.]*)(?=\0)", data)
    assert {name for name, _ in versions} == {b"GLIBC"}
    newest = max(tuple(map(int, number.split(b"."))) for _, number in versions)
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
    library = lief.PE.parse(io.BytesIO(binaries[WINDOWS.binary(MODEL)]))
    assert library is not None
    assert library.header.machine == lief.PE.Header.MACHINE_TYPES.AMD64
    table = library.get_export()
    assert table is not None
    assert {entry.name for entry in table.entries} == fmi_functions()


@pytest.mark.interop
def test_macos_libraries(binaries: dict[str, bytes]) -> None:
    found = lief.MachO.parse(io.BytesIO(binaries[MACOS.binary(MODEL)]))
    assert found is not None
    cpu = lief.MachO.Header.CPU_TYPE
    assert [library.header.cpu_type for library in found] == [cpu.X86_64, cpu.ARM64]
    for library in found:
        exports = {str(symbol.name).removeprefix("_") for symbol in library.exported_symbols}
        assert exports - MARKS_OF_THE_LINKER == fmi_functions()
        (own_name,) = (
            command.name
            for command in library.commands
            if isinstance(command, lief.MachO.DylibCommand)
            and command.command == lief.MachO.LoadCommand.TYPE.ID_DYLIB
        )
        assert own_name == "SliderResonator.dylib", "no path of the build"
        assert library.build_version.minos <= [11, 0, 0]


@pytest.mark.interop
def test_a_quick_build_is_the_same_build(complete_fmu: Path, native_fmu: Path) -> None:
    """A state that one wrote is one that the other reads."""
    assert files_in(native_fmu).items() <= files_in(complete_fmu).items()
