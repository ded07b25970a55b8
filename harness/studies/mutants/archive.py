"""The Python FMU as files that can be changed one at a time and packed again."""

import zipfile
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path, PurePosixPath

from slider_resonator.errors import FmuError

DESCRIPTION = "modelDescription.xml"
_TOOL = "pythonfmu"


@dataclass(frozen=True)
class PythonFmu:
    """The files of an FMU by their path in the archive, and its Python package's folder there."""

    files: Mapping[str, bytes]
    package: str

    @property
    def modules(self) -> dict[str, str]:
        """The source of each module of the package, by file name in alphabetical order."""
        pattern = self.path_of("*.py")
        paths = sorted(path for path in self.files if PurePosixPath(path).match(pattern))
        return {PurePosixPath(path).name: self.text(path) for path in paths}

    def path_of(self, module: str) -> str:
        """Return the path in the archive of a module such as "coulomb.py"."""
        return f"{self.package}/{module}"

    def text(self, path: str) -> str:
        """Return a file as text."""
        return self.files[path].decode("utf-8")

    def write(self, out: Path, changed: Mapping[str, str]) -> None:
        """Write an FMU with some of the files, by path, replaced."""
        content = {**self.files, **{path: text.encode() for path, text in changed.items()}}
        with zipfile.ZipFile(out, "w") as archive:  # stored: it is unpacked again at once
            for path, data in content.items():
                archive.writestr(path, data)


def files_in(path: Path) -> dict[str, bytes]:
    """Return the files in an FMU by path; FmuError when it is none."""
    try:
        with zipfile.ZipFile(path) as archive:
            return {name: archive.read(name) for name in archive.namelist()}
    except FileNotFoundError:
        raise FmuError(f"{path}: no such file") from None
    except (OSError, zipfile.BadZipFile) as error:
        raise FmuError(f"{path}: not an FMU: {error}") from error


def read_python_fmu(path: Path) -> PythonFmu:
    """Read an FMU that pythonfmu has packaged with one package of Python modules.

    Raises FmuError when it is none.
    """
    files = files_in(path)
    homes = {PurePosixPath(name).parent for name in files if name.endswith("/__init__.py")}
    packages = [str(home) for home in homes if home.name != _TOOL]
    if len(packages) != 1 or DESCRIPTION not in files:
        raise FmuError(
            f"{path}: has {len(packages)} Python packages to change; must be an FMU with "
            "one, such as SliderResonatorPy.fmu"
        )
    return PythonFmu(files, packages[0])
