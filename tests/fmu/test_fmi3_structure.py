"""The native FMU of FMI 3.0: its documents, files and functions, against standard and table."""

import re
import zipfile
from io import BytesIO
from pathlib import Path

import fmpy
import pytest
from lxml import etree

from fmu_src.building.c_sources import slider_sources
from fmu_src.building.native_fmu import build_native_3
from fmu_src.building.platforms import host_platform
from fmu_src.python.slider_component.variables import VARIABLES
from slider_resonator.checks.validate import validate
from slider_resonator.scenes.scene_files import find_scene
from tests.fmu.binary_files import elf_exports
from tests.fmu.host import Unpacked

SCHEMAS = Path(fmpy.__file__).parent / "schema" / "fmi3"
DOCUMENTS = {
    "modelDescription.xml": "fmi3ModelDescription.xsd",
    "sources/buildDescription.xml": "fmi3BuildDescription.xsd",
    "terminalsAndIcons/terminalsAndIcons.xml": "fmi3TerminalsAndIcons.xsd",
}


def fmi_3_functions() -> set[str]:
    """All functions of the standard, those of the other interface types too, by its header."""
    header = slider_sources("3.0")["fmi/fmi3Functions.h"]
    return set(re.findall(r"FMI3_Export +(?:fmi3\w+TYPE) +(fmi3\w+);", header))


@pytest.fixture(scope="module")
def inside(native_3_fmu: Path) -> dict[str, bytes]:
    with zipfile.ZipFile(native_3_fmu) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


@pytest.mark.parametrize("document", DOCUMENTS)
def test_documents_follow_their_schema(document: str, inside: dict[str, bytes]) -> None:
    schema = etree.XMLSchema(etree.parse(str(SCHEMAS / DOCUMENTS[document])))
    schema.assertValid(etree.parse(BytesIO(inside[document])))


def test_variables_are_those_of_the_table_after_the_time(unpacked_3: Unpacked) -> None:
    time, *variables = unpacked_3.description.modelVariables
    assert (time.name, time.valueReference, time.causality) == ("time", 1, "independent")
    types = {"Real": "Float64", "Integer": "Int32"}
    for reference, (row, found) in enumerate(zip(VARIABLES, variables, strict=True), start=2):
        assert (found.name, found.valueReference) == (row.name, reference)
        assert (found.type, found.causality) == (types[row.type], row.causality), row.name
        assert (found.variability, found.description) == (row.variability, row.description)
        assert (found.unit, found.displayUnit) == (row.unit, row.display_unit), row.name
        numbers = (found.start, found.min, found.max, found.nominal)
        assert [None if x is None else float(x) for x in numbers] == [
            row.start,
            row.minimum,
            row.maximum,
            row.nominal,
        ], row.name


def test_dependencies_are_those_of_the_table(unpacked_3: Unpacked) -> None:
    outputs = {v.name: v for v in VARIABLES if v.causality == "output"}
    description = unpacked_3.description
    assert [u.variable.name for u in description.outputs] == list(outputs)
    assert [u.variable.name for u in description.initialUnknowns] == list(outputs)
    for unknowns, names in (
        (description.outputs, {n: v.depends_on for n, v in outputs.items()}),
        (description.initialUnknowns, {n: v.depends_initially_on for n, v in outputs.items()}),
    ):
        for unknown in unknowns:
            found = {v.name for v in unknown.dependencies}
            assert found == set(names[unknown.variable.name]), unknown.variable.name
            assert set(unknown.dependenciesKind) <= {"dependent"}


def test_capabilities(unpacked_3: Unpacked) -> None:
    simulation = unpacked_3.description.coSimulation
    assert simulation.hasEventMode
    assert simulation.canHandleVariableCommunicationStepSize
    assert simulation.canGetAndSetFMUstate
    assert simulation.canSerializeFMUstate
    assert not simulation.canReturnEarlyAfterIntermediateUpdate
    assert not simulation.providesIntermediateUpdate
    assert not simulation.needsExecutionTool
    assert unpacked_3.description.modelExchange is None


def test_the_flange_names_variables(inside: dict[str, bytes], unpacked_3: Unpacked) -> None:
    root = etree.fromstring(inside["terminalsAndIcons/terminalsAndIcons.xml"])
    members = [m.get("variableName") for m in root.iter("TerminalMemberVariable")]
    assert members == ["position", "velocity", "load"]
    assert set(members) < {v.name for v in unpacked_3.description.modelVariables}


def test_every_source_is_inside_and_listed(inside: dict[str, bytes]) -> None:
    code = slider_sources("3.0")
    assert {n for n in inside if n.startswith("sources/") and not n.endswith(".xml")} == {
        f"sources/{name}" for name in code
    }
    root = etree.fromstring(inside["sources/buildDescription.xml"])
    listed = [e.get("name") for e in root.iter("SourceFile")]
    assert listed == sorted(name for name in code if name.endswith(".c"))
    assert not any(name.startswith("fmi2") for name in code)


@pytest.mark.skipif(host_platform("3.0").suffix != ".so", reason="reads libraries of Linux")
def test_linux_exports_the_standard(inside: dict[str, bytes]) -> None:
    (path,) = host_platform("3.0").binaries_3("SliderResonator3")
    assert elf_exports(inside[path]) == fmi_3_functions(), "nothing but FMI is shown"


@pytest.mark.interop
def test_platforms(tmp_path: Path) -> None:
    with zipfile.ZipFile(build_native_3(tmp_path)) as archive:
        binaries = {n: archive.read(n) for n in archive.namelist() if n.startswith("binaries/")}
    assert {name: binary[:2] for name, binary in binaries.items()} == {
        "binaries/aarch64-darwin/SliderResonator3.dylib": b"\xcf\xfa",
        "binaries/aarch64-linux/SliderResonator3.so": b"\x7fE",
        "binaries/x86_64-darwin/SliderResonator3.dylib": b"\xcf\xfa",
        "binaries/x86_64-linux/SliderResonator3.so": b"\x7fE",
        "binaries/x86_64-windows/SliderResonator3.dll": b"MZ",
    }
    machines = {n: b[18:20] for n, b in binaries.items() if n.endswith(".so")}
    assert machines == {
        "binaries/aarch64-linux/SliderResonator3.so": b"\xb7\x00",
        "binaries/x86_64-linux/SliderResonator3.so": b"\x3e\x00",
    }


SCENES = ("interface", "table_1", "changing_inputs", "tuned", "burst", "tuned_lugre", "leap_tuned")


@pytest.mark.parametrize("name", SCENES)
def test_scene_passes(native_3_fmu: Path, name: str) -> None:
    (result,) = validate([native_3_fmu], [find_scene(name)])
    assert not result.run_failures
    failed = [(c.quantity, c.fmu, c.reference) for c in result.checks if not c.passed]
    assert not failed, "FMI 3.0 is another shell around the same component"
