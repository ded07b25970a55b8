"""The native FMU: the C twin, compiled for every platform and as source code."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from datetime import datetime
from pathlib import Path

from fmu_src import __version__
from fmu_src.building.archive import check_folder, write_fmu
from fmu_src.building.build_error import BuildError
from fmu_src.building.compiling import (
    Compiler,
    compile_binaries,
    default_compiler,
    named_compiler,
)
from fmu_src.building.content import digest_of, guid_of, icon_and_licences
from fmu_src.building.dates import EPOCH, date_of_build, date_text
from fmu_src.building.platforms import HOST, host_platform, platforms_named
from fmu_src.c_header import C_SOURCES
from fmu_src.documentation import documentation_page
from fmu_src.model_description import model_description

MODEL = "SliderResonator"

GUID_HEADER = "model_guid.h"
_NO_GUID = "00000000-0000-0000-0000-000000000000"


def build_native(
    dest: Path,
    *,
    platforms: Sequence[str] = (),
    compiler: str | None = None,
    sources: Path = C_SOURCES,
    progress: Callable[[str], None] = lambda _: None,
) -> Path:
    """Build the native FMU in the folder `dest` (created if missing) and return its path.

    `platforms` are names of FMI 2.0 or `host`; none stand for all, or with a `compiler` for `host`.
    That is a C compiler for the platform of this machine, by default ziglang, which compiles for
    all. `sources` is the folder with the C code. The bytes depend on the sources, the compiler and
    the version of zlib, and on the environment variable SOURCE_DATE_EPOCH, which sets the date in
    the description; for macOS zig's linker leaves chance bytes in the padding besides. The file
    appears at once or not at all.

    Raises BuildError.
    """
    check_folder(dest)
    date = date_of_build()
    chosen = platforms_named([HOST] if compiler and not platforms else platforms)
    tool = default_compiler() if compiler is None else named_compiler(compiler)
    if compiler is not None and chosen != [host_platform()]:
        names = ", ".join(p.name for p in chosen)
        raise BuildError(
            f"compiler {compiler!r} refused for {names}: allowed is {host_platform().name}, the "
            "platform of this machine; ziglang compiles for the others"
        )
    code = _read_sources(sources)
    generation_tool = _generation_tool(tool)
    page = documentation_page(model=MODEL, generation_tool=generation_tool, host="native")
    files = icon_and_licences("license.txt", "fmi2.txt")
    files["documentation/index.html"] = page
    undated = _description(generation_tool, "", EPOCH, sorted(code))
    hashed = files | {f"sources/{name}": data for name, data in code.items()}
    guid = guid_of(digest_of(hashed | {"modelDescription.xml": undated}))
    code[GUID_HEADER] = _with_guid(code[GUID_HEADER], guid)
    files |= {f"sources/{name}": data for name, data in code.items()}
    files |= compile_binaries(code, MODEL, chosen, tool, progress)
    files["modelDescription.xml"] = _description(generation_tool, guid, date, sorted(code))
    return write_fmu(dest, MODEL, files)


def _read_sources(folder: Path) -> dict[str, bytes]:
    """Path below the folder -> bytes of every C file and header."""
    code = {
        path.relative_to(folder).as_posix(): path.read_bytes()
        for pattern in ("*.c", "*.h")
        for path in sorted(folder.rglob(pattern))
    }
    if GUID_HEADER not in code:
        raise BuildError(f"{folder} has no C sources of the FMU: {GUID_HEADER} is missing")
    return code


def _with_guid(header: bytes, guid: str) -> bytes:
    if header.count(_NO_GUID.encode()) != 1:
        raise BuildError(f"{GUID_HEADER} has no place for the GUID: {_NO_GUID} must be in it once")
    return header.replace(_NO_GUID.encode(), guid.encode())


def _generation_tool(compiler: Compiler) -> str:
    return f"slider-resonator {__version__} ({compiler.description})"


def _description(tool: str, guid: str, generated: datetime, code: Sequence[str]) -> bytes:
    return model_description(
        model=MODEL,
        guid=guid,
        generation_tool=tool,
        generated=date_text(generated),
        host_manages_memory=True,
        source_files=[name for name in code if name.endswith(".c")],
    )
