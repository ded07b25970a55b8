import ctypes
import re
import subprocess
from pathlib import Path

import pytest

from fmu_src.building.c_sources import slider_sources, write_sources
from fmu_src.building.cache import cached
from studies.hosts.compiler import native_compiler

FLAGS = ("-std=c99", "-O1", "-ffp-contract=off", "-fPIC", "-shared")
"""As in the FMU without fused products and sums."""

SHELL = re.compile(r"(^|/)fmi2_(?!version)[^/]*$")
"""Files of the FMI functions; the numbers need the names of their version only."""


@pytest.fixture(scope="session")
def native_library(tmp_path_factory: pytest.TempPathFactory) -> ctypes.CDLL:
    """The numbers of the native component and all probes, compiled unless nothing has changed."""
    folder = tmp_path_factory.mktemp("probes")
    probes = {path.name: path.read_text() for path in (Path(__file__).parent / "c").glob("*.c")}
    sources = slider_sources() | probes
    library = folder / "probes.so"
    files = sorted(name for name in sources if name.endswith(".c") and not SHELL.search(name))
    command = [*native_compiler(), *FLAGS, *files, "-o", library.name, "-lm"]

    def compile_all() -> bytes:
        write_sources(sources, folder)
        subprocess.run(command, check=True, cwd=folder)
        return library.read_bytes()

    origin = repr((command, sorted(sources.items()))).encode()
    library.write_bytes(cached("probes-of-tests", origin, compile_all))
    return ctypes.CDLL(str(library))
