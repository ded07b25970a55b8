"""FMUs with this interface as other tools might make them, from the native one."""

import zipfile
from pathlib import Path
from xml.etree import ElementTree as ET

import fmpy

from tests.harness.faulty_fmus import renumber, shared_library

SOURCE = Path(__file__).with_name("foreign_fmu.c")
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
        new.writestr(binary, shared_library(SOURCE, out, "-ldl"))
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
