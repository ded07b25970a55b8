from __future__ import annotations

import struct

import pytest

from fmu_src.building.universal_binary import universal_binary

X86_64, ARM64 = 0x01000007, 0x0100000C


def library(processor: int, size: int) -> bytes:
    return struct.pack("<III", 0xFEEDFACF, processor, 3).ljust(size, b"x")


def test_every_library_is_at_its_offset_in_the_header() -> None:
    libraries = [library(X86_64, 20_000), library(ARM64, 70_001)]
    data = universal_binary(libraries)
    magic, count = struct.unpack_from(">II", data)
    assert (magic, count) == (0xCAFEBABE, 2), "the header is in big-endian order"
    for k, (processor, expected) in enumerate(zip((X86_64, ARM64), libraries, strict=True)):
        found = struct.unpack_from(">IIIII", data, 8 + 20 * k)
        assert found[:2] == (processor, 3)
        offset, size, alignment = found[2:]
        assert data[offset : offset + size] == expected
        assert offset % (1 << alignment) == 0, "a library begins on a page"


def test_other_libraries_than_those_of_macos_are_refused() -> None:
    with pytest.raises(ValueError, match="begins with 0x464c457f: must be 0xfeedfacf"):
        universal_binary([b"\x7fELF" + bytes(60)])
