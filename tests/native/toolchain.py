"""Compiling the C sources of the FMU, and C programs that call them, in ways that find faults."""

import os
import shutil
import subprocess
import zipfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import pytest

from fmu_src.building.c_sources import (
    UNBUILT_GUID,
    FmiVersion,
    c_files,
    slider_sources,
    write_sources,
)
from fmu_src.building.cache import cached
from studies.hosts.compiler import compile_program, compiler_version, native_compiler
from studies.hosts.driver_host import BINARY
from studies.hosts.job import describe
from tests.processes import run_command

PROGRAMS = Path(__file__).parent / "c"
FAULT = 99
"""Exit code of a tool that has found a fault."""


@dataclass(frozen=True)
class Binary:
    """A shared library of the FMU and the GUID that it answers to."""

    library: Path
    guid: str


def unpacked_binary(fmu: Path, folder: Path, place: str = BINARY["Linux"][0]) -> Binary:
    """The binary inside an FMU for this machine, or another `place` below binaries."""
    description = describe(str(fmu))
    suffix = BINARY["Linux"][1]
    with zipfile.ZipFile(fmu) as archive:
        name = archive.extract(f"binaries/{place}/{description.identifier}{suffix}", folder)
    return Binary(Path(name), description.guid)


def program(source: Path, folder: Path, flags: Sequence[str] = ()) -> Path:
    """A C program, compiled with a sanitizer's flags or with any compiler there is.

    It may include `variables.h`, which has the value references.
    """
    compiler = sanitizing_compiler() if flags else native_compiler()
    header = folder / "variables.h"
    header.write_text(slider_sources()["component/variables.h"], encoding="utf-8")
    return compile_program(compiler, source, folder / source.stem, (*flags, f"-I{folder}"))


def sanitized_binary(folder: Path, flags: Sequence[str], version: FmiVersion = "2.0") -> Binary:
    """The C sources as a library with a sanitizer's flags, that of the last run if it can be."""
    sources = slider_sources(version)
    library = folder / "SliderResonator.so"
    compiler = sanitizing_compiler()
    command = [*compiler, "-std=c99", "-ffp-contract=off", *flags, "-fPIC", "-shared"]
    command += [*c_files(sources), "-o", library.name, "-lm"]

    def compile_all() -> bytes:
        write_sources(sources, folder)
        subprocess.run(command, cwd=folder, check=True)
        return library.read_bytes()

    origin = repr((compiler_version(compiler), command, sorted(sources.items()))).encode()
    folder.mkdir(parents=True, exist_ok=True)
    library.write_bytes(cached(f"sanitized-{version}", origin, compile_all))
    return Binary(library, UNBUILT_GUID)


def sanitizing_compiler() -> list[str]:
    return [needed("gcc", "it brings the sanitizers that ziglang lacks")]


def needed(tool: str, why: str) -> str:
    """The path of a tool without which a test cannot say anything."""
    found = shutil.which(tool)
    if found is None:
        pytest.fail(f"{tool} is not installed ({why}); `make hosts` installs it")
    return found


def run(
    command: Sequence[object], commands: str = "", environment: Mapping[str, str] | None = None
) -> subprocess.CompletedProcess[str]:
    """Run a program on standard input `commands`; the caller judges how it ended."""
    return run_command(
        *command,
        input=commands,
        env=os.environ | dict(environment or {}),
        errors="replace",
        timeout=400,
    )
