"""What the loader of a system reads in the files of the FMU: symbols and names."""

import struct
from collections.abc import Iterator
from dataclasses import dataclass

_ELF_DYNAMIC_SYMBOLS = 11
_MACH_SYMBOLS, _MACH_OWN_NAME, _MACH_BUILD_VERSION = 0x2, 0xD, 0x32
_MACH_PRIVATE, _MACH_KIND, _MACH_DEFINED, _MACH_EXTERNAL = 0x10, 0x0E, 0x0E, 0x01


def _text(data: bytes, offset: int) -> str:
    return data[offset : data.index(b"\0", offset)].decode()


@dataclass(frozen=True)
class _Section:
    kind: int
    offset: int
    size: int
    link: int


def _elf_sections(data: bytes) -> list[_Section]:
    assert data[:6] == b"\x7fELF\x02\x01", "64 bits, little-endian"
    (table,) = struct.unpack_from("<Q", data, 40)
    entry, count = struct.unpack_from("<HH", data, 58)
    found = []
    for i in range(count):
        at = table + i * entry
        (kind,) = struct.unpack_from("<I", data, at + 4)
        offset, size, link = struct.unpack_from("<QQI", data, at + 24)
        found.append(_Section(kind, offset, size, link))
    return found


def elf_exports(data: bytes) -> set[str]:
    """Names of the symbols that a Linux library defines for others."""
    sections = _elf_sections(data)
    (symbols,) = (s for s in sections if s.kind == _ELF_DYNAMIC_SYMBOLS)
    names = set()
    for at in range(symbols.offset, symbols.offset + symbols.size, 24):
        name, _, _, section = struct.unpack_from("<IBBH", data, at)
        if section != 0:
            names.add(_text(data, sections[symbols.link].offset + name))
    return names


def pe_exports(data: bytes) -> set[str]:
    """Names that a Windows library exports."""
    (header,) = struct.unpack_from("<I", data, 0x3C)
    assert data[header : header + 4] == b"PE\0\0"
    (count,) = struct.unpack_from("<H", data, header + 6)
    (optional,) = struct.unpack_from("<H", data, header + 20)
    assert struct.unpack_from("<H", data, header + 24) == (0x20B,), "64 bits"
    (exports,) = struct.unpack_from("<I", data, header + 24 + 112)
    places: list[tuple[int, int, int]] = []
    for i in range(count):
        at = header + 24 + optional + 40 * i
        size, address, stored, offset = struct.unpack_from("<IIII", data, at + 8)
        places.append((address, max(size, stored), offset))

    def in_file(address: int) -> int:
        return next(o + address - a for a, size, o in places if a <= address < a + size)

    names, table = struct.unpack_from("<I4xI", data, in_file(exports) + 24)
    references = struct.unpack_from(f"<{names}I", data, in_file(table))
    return {_text(data, in_file(r)) for r in references}


@dataclass(frozen=True)
class MachLibrary:
    """A macOS library for one processor: its exports, own name and first system (major, minor)."""

    processor: int
    exports: frozenset[str]
    own_name: str
    first_system: tuple[int, int]


def mach_libraries(data: bytes) -> Iterator[MachLibrary]:
    """The libraries in a universal binary."""
    magic, count = struct.unpack_from(">II", data)
    assert magic == 0xCAFEBABE
    for i in range(count):
        offset, size = struct.unpack_from(">II", data, 8 + 20 * i + 8)
        yield _mach_library(data[offset : offset + size])


def _mach_library(data: bytes) -> MachLibrary:
    magic, processor, _, _, commands = struct.unpack_from("<IIIII", data)
    assert magic == 0xFEEDFACF
    exports: set[str] = set()
    own_name, first_system, at = "", (0, 0), 32
    for _ in range(commands):
        command, size = struct.unpack_from("<II", data, at)
        if command == _MACH_SYMBOLS:
            exports = set(_mach_exports(data, *struct.unpack_from("<III", data, at + 8)))
        elif command == _MACH_OWN_NAME:
            (name,) = struct.unpack_from("<I", data, at + 8)
            own_name = _text(data, at + name)
        elif command == _MACH_BUILD_VERSION:
            (version,) = struct.unpack_from("<I", data, at + 12)
            first_system = version >> 16, version >> 8 & 0xFF
        at += size
    return MachLibrary(processor, frozenset(exports), own_name, first_system)


def _mach_exports(data: bytes, table: int, count: int, strings: int) -> Iterator[str]:
    for at in range(table, table + 16 * count, 16):
        name, kind = struct.unpack_from("<IB", data, at)
        defined = kind & _MACH_KIND == _MACH_DEFINED
        if defined and kind & _MACH_EXTERNAL and not kind & _MACH_PRIVATE:
            yield _text(data, strings + name).removeprefix("_")
