"""Open an FMU: unpack the archive, read its description and check its interface."""

import zipfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from xml.etree import ElementTree as ET

import fmpy
from fmpy.model_description import (
    CoSimulation,
    ModelDescription,
    ModelVariable,
    read_model_description,
)

from slider_resonator.device.interface import SETTABLE, VARIABLES
from slider_resonator.device.variable import FIRST
from slider_resonator.errors import FmuError, HarnessError, NotApplicable, unknown_name
from slider_resonator.fmu.interface_check import interface_problems
from slider_resonator.fmu.limits import MAX_ENTRIES, UNPACKED, max_bytes
from slider_resonator.output.files import temporary_folder

_TYPES_OF_FMI_3 = {"Float64": "Real", "Int32": "Integer"}
"""Type of FMI 3.0 to that of FMI 2.0, which the harness speaks of."""


@dataclass(frozen=True)
class Fmu:
    """An FMU unpacked in a folder that lasts as long as the `open_fmu` block.

    `path` is how it was named, `file` the same from any folder.
    """

    path: Path
    file: Path
    folder: Path
    description: ModelDescription
    variables: Mapping[str, ModelVariable]

    @property
    def offers(self) -> CoSimulation:
        """The capability flags of its description, and the model identifier."""
        return self.description.coSimulation

    @property
    def version(self) -> str:
        """The version of FMI: 2.0 or 3.0."""
        return "3.0" if self.description.fmiVersion.startswith("3.") else "2.0"

    @property
    def runs_without_python(self) -> bool:
        """Whether a host without Python can load it: it contains no Python sources."""
        return not any((self.folder / "resources").glob("*.py"))

    @cached_property
    def log_categories(self) -> frozenset[str]:
        """The names of its log categories, which fmpy does not read."""
        root = ET.parse(self.folder / "modelDescription.xml")
        return frozenset(one.get("name", "") for one in root.iter("Category"))

    @property
    def takes_equal_steps_only(self) -> bool:
        """Whether all communication steps of a run must have one size, by the FMU's description."""
        return not self.offers.canHandleVariableCommunicationStepSize

    @property
    def interpolates(self) -> bool:
        """Whether it takes derivatives of inputs, by its description; FMI 3.0 has none."""
        return bool(self.offers.canInterpolateInputs)

    @property
    def has_orders(self) -> bool:
        """Whether averages have a choice of orders."""
        return "averaging_order" in self.variables

    def settable(self, name: str) -> ModelVariable:
        """Return the parameter or input called `name`; FmuError names the nearest if none is."""
        if name not in SETTABLE:
            raise FmuError(unknown_name("parameter or input", name, SETTABLE))
        return self.variable(name)

    def variable(self, name: str) -> ModelVariable:
        """Return a variable; FmuError for an unknown name, NotApplicable for one it may lack."""
        if name in self.variables:
            return self.variables[name]
        if name in VARIABLES:
            since = VARIABLES[name].since
            raise NotApplicable(f"needs {name}, which came with interface {since}")
        raise FmuError(unknown_name("variable", name, self.variables))

    def reference(self, name: str) -> int:
        """Return the value reference of a variable; raises as `variable` does."""
        return int(self.variable(name).valueReference)

    def settings(self, values: Mapping[str, float]) -> Mapping[str, float]:
        """Return the values without those that the interface assumes of variables that it lacks."""
        return {
            name: value
            for name, value in values.items()
            if name in self.variables or name not in VARIABLES or value != VARIABLES[name].without
        }

    def require(self, capability: str, *, of: bool = True) -> None:
        """Raise NotApplicable unless a capability flag of the description has the given value."""
        if bool(getattr(self.offers, capability)) is not of:
            raise NotApplicable(f"needs {capability} = {str(of).lower()}")

    @property
    def outputs(self) -> tuple[str, ...]:
        """The outputs of the interface that it has."""
        found = (v.name for v in VARIABLES.values() if v.causality == "output")
        return tuple(name for name in found if name in self.variables)


@contextmanager
def open_fmu(path: str | Path) -> Iterator[Fmu]:
    """Unpack the FMU at `path` for the length of the block.

    Raises FmuError when it is no co-simulation FMU of FMI 2.0 or 3.0, lacks a variable of the
    interface, gives one of them another causality, type or unit, has no binary for this platform,
    or is too large unpacked.
    """
    path = Path(path)
    description = _read_description(path)
    variables = {variable.name: variable for variable in description.modelVariables}
    if description.coSimulation is None:
        raise FmuError(f"{path}: an FMU for model exchange only; must be co-simulation")
    problems = interface_problems(description) or _platform_problems(path, description)
    if problems:
        raise FmuError(f"{path}: not usable as a slider-resonator: {'; '.join(problems)}")
    with temporary_folder() as folder:
        unpacked = folder / "unpacked"
        try:
            fmpy.extract(path, unpacked)
        except Exception as error:  # fmpy raises bare Exception for illegal paths
            raise FmuError(f"{path}: cannot be unpacked: {error}") from error
        yield Fmu(path, path.resolve(), unpacked, description, variables)


def lacking(path: Path) -> tuple[str, ...]:
    """Return the later variables of the interface that an FMU file lacks; none if unusable."""
    try:
        present = {variable.name for variable in _read_description(path).modelVariables}
    except FmuError:
        return ()
    later = (name for name, variable in VARIABLES.items() if variable.since != FIRST)
    return tuple(name for name in later if name not in present)


def _read_description(path: Path) -> ModelDescription:
    if not path.is_file():
        problem = "is a directory; must be an FMU file" if path.is_dir() else "no such file"
        raise FmuError(f"{path}: {problem}")
    try:
        check_unpacked_size(path)
        with zipfile.ZipFile(path) as archive:
            root = ET.fromstring(archive.read("modelDescription.xml"))
        version = root.get("fmiVersion", "unknown")
        if version not in ("2.0", "3.0"):
            raise FmuError(f"{path}: FMI version {version}; must be 2.0 or 3.0")
        description = read_model_description(str(path))
        # Unknowns without dependencies depend on everything; for fmpy they depend on nothing.
        for kind in ("Output", "InitialUnknown"):
            read = description.outputs if kind == "Output" else description.initialUnknowns
            structure = f"ModelStructure/{kind}"  # FMI 2.0 has a list of them
            listed = root.findall(f"{structure}s/Unknown") or root.findall(structure)
            for unknown, found in zip(read, listed, strict=True):
                if "dependencies" not in found.attrib:
                    unknown.dependencies = None
        for variable in description.modelVariables:
            variable.type = _TYPES_OF_FMI_3.get(variable.type, variable.type)
        return description
    except HarnessError:
        raise
    except Exception as error:  # fmpy, lxml and the schema each raise their own
        raise FmuError(f"{path}: not an FMU: cannot read modelDescription.xml: {error}") from error


def check_unpacked_size(path: Path) -> None:
    """Raise FmuError for a file that is no zip archive, or that unpacks to more than the limits."""
    if not zipfile.is_zipfile(path):
        raise FmuError(f"{path}: must be a zip archive, as FMUs and SSP packages are")
    with zipfile.ZipFile(path) as archive:
        entries = archive.infolist()
    size = sum(entry.file_size for entry in entries)
    if len(entries) > MAX_ENTRIES:
        raise FmuError(f"{path}: {len(entries)} files; must be at most {MAX_ENTRIES}")
    if size > (allowed := max_bytes(UNPACKED)):
        raise FmuError(
            f"{path}: {size >> 20} MiB unpacked; must be at most {allowed >> 20} MiB "
            "(--max-unpacked)"
        )


def _platform_problems(path: Path, description: ModelDescription) -> list[str]:
    # fmpy names the platforms of FMI 2.0 only.
    ours = fmpy.platform if description.fmiVersion == "2.0" else fmpy.platform_tuple
    with zipfile.ZipFile(path) as archive:
        parts = [name.split("/") for name in archive.namelist()]
    platforms = sorted({p[1] for p in parts if p[0] == "binaries" and len(p) > 2})
    others = ", ".join(platforms) or "no platform"
    return [] if ours in platforms else [f"no binary for {ours}, only for {others}"]
