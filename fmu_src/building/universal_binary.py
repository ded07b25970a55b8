"""One macOS library for several processors: a header, then a library for each."""

import struct
from collections.abc import Sequence

_MAGIC = 0xCAFEBABE
_THIN_MAGIC = 0xFEEDFACF
_ALIGNMENT = 14  # as a power of two: pages of 16 kB


def universal_binary(libraries: Sequence[bytes]) -> bytes:
    """Join libraries (64-bit Mach-O, one per processor) to one file.

    Raises ValueError for anything else.
    """
    page = 1 << _ALIGNMENT
    header = struct.pack(">II", _MAGIC, len(libraries))
    body = b""
    for library in libraries:
        magic, processor, variant = struct.unpack_from("<III", library)
        if magic != _THIN_MAGIC:
            raise ValueError(f"a library begins with {magic:#x}: must be {_THIN_MAGIC:#x}")
        body += b"\0" * (-len(body) % page)
        offset = page + len(body)
        header += struct.pack(">IIIII", processor, variant, offset, len(library), _ALIGNMENT)
        body += library
    return header.ljust(page, b"\0") + body
