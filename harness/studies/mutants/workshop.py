"""Build native FMUs from changed C sources, compiling only what a change touches."""

import re
import shutil
import subprocess
import zipfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import fmpy

from slider_resonator.errors import FmuError, HarnessError
from studies.mutants.archive import DESCRIPTION, files_in
from studies.mutants.changes import Change

FLAGS = ("-std=c99", "-O1", "-fPIC", "-fvisibility=hidden", "-ffp-contract=off", "-w")
COMPILERS = ("gcc", "clang", "cc")

_SOURCES = "sources/"
_VERSION_3 = re.compile(r'fmiVersion="3\.')
_IDENTIFIER = re.compile(r'modelIdentifier="(\w+)"')


@dataclass(frozen=True)
class NativeSources:
    """The C sources of an FMU by path, its model description, and the path of its library."""

    files: Mapping[str, str]
    description: str
    library: str

    @property
    def units(self) -> list[str]:
        """The files to be compiled, in alphabetical order."""
        return sorted(name for name in self.files if name.endswith(".c"))


def read_native_sources(path: Path) -> NativeSources:
    """Read the C sources in an FMU; FmuError when it has none."""
    inside = files_in(path)
    files = {
        name.removeprefix(_SOURCES): content.decode("utf-8")
        for name, content in inside.items()
        if name.startswith(_SOURCES) and name.endswith((".c", ".h"))
    }
    description = inside.get(DESCRIPTION, b"").decode("utf-8")
    model = _IDENTIFIER.search(description)
    if not files or model is None:
        raise FmuError(
            f"{path}: has no C sources to change; must be an FMU with a folder sources, such as "
            "SliderResonator.fmu"
        )
    platform = fmpy.platform_tuple if _VERSION_3.search(description) else fmpy.platform
    library = f"binaries/{platform}/{model.group(1)}{fmpy.sharedLibraryExtension}"
    return NativeSources(files, description, library)


class Workshop:
    """Compiled units of the unchanged sources in a folder, and FMUs with one file changed.

    Raises HarnessError when there is no C compiler or the sources do not compile.
    """

    def __init__(self, sources: NativeSources, folder: Path) -> None:
        self._sources = sources
        self._folder = folder
        self._compiler = next(filter(None, map(shutil.which, COMPILERS)), None)
        if self._compiler is None:
            raise HarnessError(f"no C compiler is found; must be one of {', '.join(COMPILERS)}")
        self._compile(folder, sources.files, sources.units)

    def write(self, change: Change, out: Path) -> None:
        """Write an FMU for this machine with a change; HarnessError when it does not compile."""
        place = self._folder / change.name
        files = {**self._sources.files, change.file: change.applied(self._sources.files)}
        units = [change.file] if change.file in self._sources.units else self._sources.units
        self._compile(place, files, units)
        objects = [
            f"{place if unit in units else self._folder}/{unit}.o" for unit in self._sources.units
        ]
        self._call(["-shared", "-o", "library", *objects, "-lm"], place)
        with zipfile.ZipFile(out, "w") as archive:  # stored: it is unpacked again at once
            archive.writestr(DESCRIPTION, self._sources.description)
            archive.write(place / "library", self._sources.library)
        shutil.rmtree(place)

    def _compile(self, folder: Path, files: Mapping[str, str], units: Sequence[str]) -> None:
        for name, text in files.items():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            (folder / name).write_text(text, encoding="utf-8", newline="\n")
        for unit in units:
            self._call([*FLAGS, "-c", unit, "-o", f"{unit}.o"], folder)

    def _call(self, arguments: Sequence[str], folder: Path) -> None:
        command = [f"{self._compiler}", *arguments]
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise HarnessError(
                f"{folder.name}: {self._compiler} cannot compile:\n{done.stderr.strip()}"
            )
