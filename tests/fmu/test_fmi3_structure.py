"""The native FMU of FMI 3.0: its documents against their schemas, and scenes."""

import zipfile
from io import BytesIO
from pathlib import Path

import fmpy
import pytest
from lxml import etree

from slider_resonator.checks.validate import validate
from slider_resonator.scenes.scene_files import find_scene
from tests.fmu.host import Unpacked

SCHEMAS = Path(fmpy.__file__).parent / "schema" / "fmi3"
DOCUMENTS = {
    "modelDescription.xml": "fmi3ModelDescription.xsd",
    "sources/buildDescription.xml": "fmi3BuildDescription.xsd",
    "terminalsAndIcons/terminalsAndIcons.xml": "fmi3TerminalsAndIcons.xsd",
}


@pytest.fixture(scope="module")
def inside(native_3_fmu: Path) -> dict[str, bytes]:
    with zipfile.ZipFile(native_3_fmu) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


@pytest.mark.parametrize("document", DOCUMENTS)
def test_documents_follow_their_schema(document: str, inside: dict[str, bytes]) -> None:
    schema = etree.XMLSchema(etree.parse(str(SCHEMAS / DOCUMENTS[document])))
    schema.assertValid(etree.parse(BytesIO(inside[document])))


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


SCENES = ("interface", "table_1", "changing_inputs", "tuned", "burst")


@pytest.mark.parametrize("name", SCENES)
def test_scene_passes(native_3_fmu: Path, name: str) -> None:
    (result,) = validate([native_3_fmu], [find_scene(name)])
    assert not result.run_failures
    failed = [(c.quantity, c.fmu, c.reference) for c in result.checks if not c.passed]
    assert not failed, "FMI 3.0 is another shell around the same component"
