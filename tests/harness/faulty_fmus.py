"""FMUs made from the native one: wrong in one way each, old, or as other tools might make them."""

import re
import subprocess
import sys
import zipfile
from collections.abc import Callable
from pathlib import Path
from xml.etree import ElementTree as ET

import fmpy

from slider_resonator.device.interface import VARIABLES
from slider_resonator.device.variable import FIRST
from studies.mutants.archive import files_in

SOURCE = Path(__file__).with_name("faulty_fmu.c")
DESCRIPTION = "modelDescription.xml"
SCENE = """
name = "{}"
title = "A few periods of table 1"

[run]
drive_periods = 2
steps_per_period = 8

[[expect]]
quantity = "position"
reference = "located_events"
relative = 1e-8
why = "the motion itself must agree"
"""


def scene(folder: Path, name: str = "short") -> Path:
    """Write a scene of two drive periods."""
    path = folder / f"{name}.toml"
    path.write_text(SCENE.format(name))
    return path


def altered(fmu: Path, out: Path, alter: Callable[[str, bytes], bytes | None]) -> Path:
    """Copy an FMU with each file replaced by what `alter` makes of it, or left out for None."""
    files = files_in(fmu)
    others = {name: alter(name, content) for name, content in files.items()}
    assert others != files, "the alteration must alter something"
    with zipfile.ZipFile(out, "w") as new:
        for name, content in others.items():
            if content is not None:
                new.writestr(name, content)
    return out


def redescribed(fmu: Path, out: Path, old: bytes, new: bytes, file: str = DESCRIPTION) -> Path:
    """Copy an FMU with one place in its description, or in another file, replaced."""

    def alter(name: str, content: bytes) -> bytes:
        return content.replace(old, new, 1) if name == file else content

    return altered(fmu, out, alter)


def reworded(archive: Path, out: Path, old: str, new: str) -> Path:
    """Copy an FMU or a package with a text replaced in all its files."""
    return altered(archive, out, lambda _, content: content.replace(old.encode(), new.encode()))


def renumber(root: ET.Element, places: dict[str, str]) -> None:
    """Give the variables of the structure their new indices, and leave out those without one."""
    for parent in root.iterfind("ModelStructure/*"):
        parent[:] = [unknown for unknown in parent if unknown.attrib["index"] in places]
        for unknown in parent:
            unknown.set("index", places[unknown.attrib["index"]])
            kept = [i for i in unknown.attrib.get("dependencies", "").split() if i in places]
            unknown.set("dependencies", " ".join(places[index] for index in kept))
            unknown.attrib.pop("dependenciesKind", None)
        parent[:] = sorted(parent, key=lambda unknown: int(unknown.attrib["index"]))


def without_later_variables(fmu: Path, out: Path) -> Path:
    """Copy an FMU without the variables that came after the first version of the interface."""

    def alter(name: str, content: bytes) -> bytes:
        if name != DESCRIPTION:
            return content
        root = ET.fromstring(content)
        variables = root.find("ModelVariables")
        assert variables is not None
        places: dict[str, str] = {}
        for index, variable in enumerate(list(variables), start=1):
            if VARIABLES[variable.attrib["name"]].since == FIRST:
                places[str(index)] = str(len(places) + 1)
            else:
                variables.remove(variable)
        renumber(root, places)
        root.set("description", "without later variables")
        return ET.tostring(root)

    return altered(fmu, out, alter)


def other_friction(python_fmu: Path, out: Path) -> Path:
    """Copy the Python FMU with 0.1 % more friction than its description says.

    Its modules have other names, so that one process can run both.
    """
    row = b"tunable friction_coefficient 1, start 0.1"
    files = files_in(python_fmu)
    (digest,) = set(re.findall(r"slider_component_([0-9a-f]{12})/", " ".join(files)))
    assert sum(content.count(row) for content in files.values()) == 1
    with zipfile.ZipFile(out, "w") as new:
        for name, content in files.items():
            other = content.replace(digest.encode(), digest[::-1].encode())
            new.writestr(name.replace(digest, digest[::-1]), other.replace(row, row + b"001"))
    return out


def shared_library(source: Path, fmu: Path, *arguments: str) -> bytes:
    """Compile a source for this platform, beside the FMU that it is for."""
    library = fmu.with_suffix(".library")
    command = [sys.executable, "-m", "ziglang", "cc", "-shared", "-fPIC", "-O1", "-std=gnu99"]
    subprocess.run([*command, "-o", str(library), str(source), *arguments], check=True)
    return library.read_bytes()


def compiled(fmu: Path, out: Path, *defines: str) -> Path:
    """Copy an FMU with its binary for this platform replaced by `faulty_fmu.c`."""
    library = shared_library(SOURCE, out, *(f"-D{define}" for define in defines))

    def alter(name: str, content: bytes) -> bytes:
        return library if name.startswith(f"binaries/{fmpy.platform}/") else content

    return altered(fmu, out, alter)


IDENTIFIER = "foreign_slider"
FLAGS = (
    "canGetAndSetFMUstate",
    "canSerializeFMUstate",
    "canHandleVariableCommunicationStepSize",
    "canInterpolateInputs",
)


def foreign(fmu: Path, out: Path) -> Path:
    """Write an FMU with another order of variables, other references and fewer capabilities."""
    with zipfile.ZipFile(fmu) as old, zipfile.ZipFile(out, "w") as new:
        (original,) = (n for n in old.namelist() if n.startswith(f"binaries/{fmpy.platform}/"))
        new.writestr("resources/original.so", old.read(original))
        new.writestr("modelDescription.xml", _description(old.read("modelDescription.xml")))
        binary = f"binaries/{fmpy.platform}/{IDENTIFIER}{Path(original).suffix}"
        new.writestr(binary, shared_library(SOURCE.with_name("foreign_fmu.c"), out, "-ldl"))
    return out


def _description(xml: bytes) -> bytes:
    root = ET.fromstring(xml)
    simulation = root.find("CoSimulation")
    assert simulation is not None
    for source_files in simulation.findall("SourceFiles"):
        simulation.remove(source_files)
    simulation.attrib.update(dict.fromkeys(FLAGS, "false"), modelIdentifier=IDENTIFIER)
    simulation.set("canBeInstantiatedOnlyOncePerProcess", "true")
    simulation.set("maxOutputDerivativeOrder", "0")  # the calls are those of the other references
    for element in ("LogCategories", "DefaultExperiment"):
        for found in root.findall(element):
            root.remove(found)
    units = root.find("UnitDefinitions")
    assert units is not None
    for unit in units:
        for display in unit.findall("DisplayUnit"):
            unit.remove(display)
    renumber(root, _turn_round(root))
    return ET.tostring(root)


def _turn_round(root: ET.Element) -> dict[str, str]:
    """Reverse the variables and give them other references; return old index to new index."""
    variables = root.find("ModelVariables")
    assert variables is not None
    for variable in variables:
        variable.set("valueReference", str(1000 + 7 * int(variable.attrib["valueReference"])))
        del variable.attrib["description"]
        for kind in variable:
            for name in ("displayUnit", "nominal"):
                kind.attrib.pop(name, None)
    variables[:] = reversed(variables)
    count = len(variables)
    return {str(old): str(count + 1 - old) for old in range(1, count + 1)}
