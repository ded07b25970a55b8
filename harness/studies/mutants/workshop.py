"""Build native FMUs from changed C sources, compiling only what a change touches."""

from __future__ import annotations

import posixpath
import re
import shutil
import subprocess
import zipfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path, PurePosixPath

import fmpy

from slider_resonator.errors import FmuError, HarnessError
from studies.mutants.archive import DESCRIPTION
from studies.mutants.changes import Change

FLAGS = ("-std=c99", "-O1", "-fPIC", "-fvisibility=hidden", "-ffp-contract=off", "-w")
COMPILERS = ("gcc", "clang", "cc")
TIME_LIMIT = 120.0
"""Seconds for a call of the compiler."""

_INCLUDE = re.compile(r'^#include "([^"]+)"', re.MULTILINE)
_SOURCES = "sources/"
_VERSION_3 = re.compile(r'fmiVersion="3\.')
_IDENTIFIER = re.compile(r'modelIdentifier="(\w+)"')


@dataclass(frozen=True)
class NativeSources:
    """The C sources of an FMU by path, its model description and model identifier."""

    files: Mapping[str, str]
    description: bytes
    model: str

    @property
    def binary(self) -> str:
        """The path of the library for this machine in the FMU."""
        version_3 = _VERSION_3.search(self.description.decode("utf-8", "replace"))
        platform = fmpy.platform_tuple if version_3 else fmpy.platform
        return f"binaries/{platform}/{self.model}{fmpy.sharedLibraryExtension}"

    @property
    def units(self) -> list[str]:
        """The files to be compiled, in alphabetical order."""
        return sorted(name for name in self.files if name.endswith(".c"))

    def units_with(self, file: str) -> list[str]:
        """Return the units that are or include a file, directly or not."""
        return [unit for unit in self.units if file in self._included(unit)]

    def _included(self, unit: str) -> set[str]:
        found, waiting = set[str](), [unit]
        while waiting:
            name = waiting.pop()
            if name not in found and name in self.files:
                found.add(name)
                folder = posixpath.dirname(name)
                paths = (posixpath.join(folder, p) for p in _INCLUDE.findall(self.files[name]))
                waiting += map(posixpath.normpath, paths)
        return found


def read_native_sources(path: Path) -> NativeSources:
    """Read the C sources in an FMU; FmuError when it has none."""
    try:
        with zipfile.ZipFile(path) as archive:
            inside = archive.namelist()
            files = {
                name.removeprefix(_SOURCES): archive.read(name).decode("utf-8")
                for name in inside
                if name.startswith(_SOURCES) and PurePosixPath(name).suffix in (".c", ".h")
            }
            description = archive.read(DESCRIPTION) if DESCRIPTION in inside else b""
    except FileNotFoundError:
        raise FmuError(f"{path}: no such file") from None
    except (OSError, zipfile.BadZipFile, UnicodeDecodeError) as error:
        raise FmuError(f"{path}: not an FMU: {error}") from error
    model = _IDENTIFIER.search(description.decode("utf-8", "replace"))
    if not files or model is None:
        raise FmuError(
            f"{path}: has no C sources to change; must be an FMU with a folder sources, such as "
            "SliderResonator.fmu"
        )
    return NativeSources(files, description, model.group(1))


class Workshop:
    """Compiled units of the unchanged sources in a folder, and FMUs with one file changed.

    Raises HarnessError when there is no C compiler or the sources do not compile.
    """

    def __init__(self, sources: NativeSources, folder: Path) -> None:
        self._sources = sources
        self._folder = folder
        self._compiler = _compiler()
        self._compile(folder, sources.files, sources.units)

    def write(self, change: Change, out: Path) -> None:
        """Write an FMU for this machine with a change; HarnessError when it does not compile."""
        place = self._folder / change.name
        files = {**self._sources.files, change.file: change.applied(self._sources.files)}
        units = self._sources.units_with(change.file)
        self._compile(place, files, units)
        objects = [
            f"{place if unit in units else self._folder}/{unit}.o" for unit in self._sources.units
        ]
        library = place / "library"
        self._call(["-shared", "-o", str(library), *objects, "-lm"], place)
        with zipfile.ZipFile(out, "w") as archive:  # stored: it is unpacked again at once
            archive.writestr(DESCRIPTION, self._sources.description)
            archive.write(library, self._sources.binary)
        shutil.rmtree(place)

    def _compile(self, folder: Path, files: Mapping[str, str], units: Sequence[str]) -> None:
        for name, text in files.items():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            (folder / name).write_text(text, encoding="utf-8", newline="\n")
        for unit in units:
            self._call([*FLAGS, "-c", unit, "-o", f"{unit}.o"], folder)

    def _call(self, arguments: Sequence[str], folder: Path) -> None:
        command = [self._compiler, *arguments]
        try:
            done = subprocess.run(
                command,
                cwd=folder,
                capture_output=True,
                text=True,
                check=False,
                timeout=TIME_LIMIT,
            )
        except subprocess.TimeoutExpired as error:
            raise HarnessError(f"{self._compiler} takes more than {TIME_LIMIT:.0f} s") from error
        if done.returncode != 0:
            raise HarnessError(
                f"{folder.name}: {self._compiler} cannot compile:\n{done.stderr.strip()}"
            )


def _compiler() -> str:
    for name in COMPILERS:
        found = shutil.which(name)
        if found is not None:
            return found
    raise HarnessError(f"no C compiler is found; must be one of {', '.join(COMPILERS)}")
