"""The numbers of the native component as a library with probes, compiled for tests."""

from __future__ import annotations

import ctypes
import re
import subprocess
from pathlib import Path

from fmu_src.building.c_sources import slider_sources, write_sources
from studies.hosts.compiler import native_compiler

PROBES = Path(__file__).parent / "c"
FLAGS = ("-std=c99", "-O1", "-ffp-contract=off", "-fPIC", "-shared")
"""As in the FMU without fused products and sums."""

_SHELL = re.compile(r"fmi2_(?!version)")
"""Files of the FMI functions; the numbers need the names of their version only."""


def compiled_library(folder: Path) -> ctypes.CDLL:
    """Compile the sources and all probes into a folder."""
    probes = {path.name: path.read_text() for path in PROBES.glob("*.c")}
    write_sources(slider_sources() | probes, folder)
    library = folder / "probes.so"
    sources = sorted(str(path) for path in folder.rglob("*.c") if not _SHELL.match(path.name))
    command = [*native_compiler(), *FLAGS, *sources, "-o", str(library), "-lm"]
    subprocess.run(command, check=True)
    return ctypes.CDLL(str(library))
