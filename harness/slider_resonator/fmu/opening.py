"""Open an FMU: unpack the archive, read its description and check its interface."""

from __future__ import annotations

import shutil
import tempfile
import zipfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree as ET

import fmpy
from fmpy.model_description import ModelDescription, ModelVariable, read_model_description

from slider_resonator.device.interface import INPUTS, PARAMETERS
from slider_resonator.errors import FmuError, unknown_name
from slider_resonator.fmu.interface_check import interface_problems


@dataclass(frozen=True)
class Fmu:
    """An FMU unpacked in a folder that lasts as long as the `open_fmu` block."""

    path: Path
    folder: Path
    description: ModelDescription
    variables: Mapping[str, ModelVariable]

    @property
    def version(self) -> str:
        """The version of FMI: 2.0 or 3.0."""
        return "3.0" if self.description.fmiVersion.startswith("3.") else "2.0"

    @property
    def identifier(self) -> str:
        """The model identifier, which is also the name of the binary."""
        return str(self.description.coSimulation.modelIdentifier)

    @property
    def runs_without_python(self) -> bool:
        """Whether a host without Python can load it: it contains no Python sources."""
        return not any((self.folder / "resources").glob("*.py"))

    @property
    def takes_equal_steps_only(self) -> bool:
        """Whether all communication steps of a run must have one size, by the FMU's description."""
        return not self.description.coSimulation.canHandleVariableCommunicationStepSize

    def settable(self, name: str) -> ModelVariable:
        """Return the parameter or input called `name`; FmuError names the nearest if none is."""
        allowed = [*PARAMETERS, *INPUTS]
        if name not in allowed:
            raise FmuError(unknown_name("parameter or input", name, allowed))
        return self.variables[name]


@contextmanager
def open_fmu(path: str | Path) -> Iterator[Fmu]:
    """Unpack the FMU at `path` for the length of the block.

    Raises FmuError when it is no co-simulation FMU of FMI 2.0 or 3.0, lacks a variable of the
    interface, gives one of them another causality, type or unit, or has no binary for this
    platform.
    """
    path = Path(path)
    description = _read_description(path)
    variables = {variable.name: variable for variable in description.modelVariables}
    _check_interface(path, description)
    folder = Path(tempfile.mkdtemp(prefix="slider-resonator-"))
    try:
        try:
            fmpy.extract(path, folder)
        except Exception as error:  # fmpy raises bare Exception for illegal paths
            raise FmuError(f"{path}: cannot be unpacked: {error}") from error
        yield Fmu(path, folder, description, variables)
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def _read_description(path: Path) -> ModelDescription:
    if path.is_dir():
        raise FmuError(f"{path}: is a directory; must be an FMU file")
    if not path.is_file():
        raise FmuError(f"{path}: no such file")
    if not zipfile.is_zipfile(path):
        raise FmuError(f"{path}: not an FMU: it is no zip archive")
    try:
        version = _fmi_version(path)
        if version not in ("2.0", "3.0"):
            raise FmuError(f"{path}: FMI version {version}; must be 2.0 or 3.0")
        return read_model_description(str(path))
    except FmuError:
        raise
    except Exception as error:  # fmpy, lxml and the schema each raise their own
        raise FmuError(f"{path}: modelDescription.xml cannot be read: {error}") from error


def _fmi_version(path: Path) -> str:
    """Return the FMI version of the description, before the rest is read."""
    with zipfile.ZipFile(path) as archive:
        if "modelDescription.xml" not in archive.namelist():
            raise FmuError(f"{path}: not an FMU: the archive has no modelDescription.xml")
        with archive.open("modelDescription.xml") as file:
            _, root = next(iter(ET.iterparse(file, events=("start",))))
            return str(root.get("fmiVersion", "unknown"))


def _check_interface(path: Path, description: ModelDescription) -> None:
    if description.coSimulation is None:
        raise FmuError(f"{path}: an FMU for model exchange only; must be co-simulation")
    problems = interface_problems(description)
    if not problems:
        problems += _platform_problems(path, description)
    if problems:
        raise FmuError(f"{path}: not usable as a slider-resonator: {'; '.join(problems)}")


def _platform_problems(path: Path, description: ModelDescription) -> list[str]:
    if description.fmiVersion == "2.0":
        ours, platforms = fmpy.platform, fmpy.supported_platforms(str(path))
    else:
        # fmpy does not know the platform tuples of other processors.
        ours = fmpy.platform_tuple
        with zipfile.ZipFile(path) as archive:
            parts = [name.split("/") for name in archive.namelist()]
        platforms = sorted({p[1] for p in parts if p[0] == "binaries" and len(p) > 2})
    if ours in platforms:
        return []
    return [f"no binary for {ours}, only for {', '.join(platforms) or 'none'}"]
