"""The native FMU of FMI 3.0: its description, and scenes."""

import zipfile
from pathlib import Path

import fmpy
import pytest
from lxml import etree

from slider_resonator.checks.validate import validate
from slider_resonator.scenes.scene_files import find_scene
from tests.fmu.host import Unpacked

SCHEMA = Path(fmpy.__file__).parent / "schema" / "fmi3" / "fmi3TerminalsAndIcons.xsd"


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


def test_the_flange_names_variables(native_3_fmu: Path, unpacked_3: Unpacked) -> None:
    """In a document that fmpy's validation does not read."""
    with zipfile.ZipFile(native_3_fmu) as archive:
        root = etree.fromstring(archive.read("terminalsAndIcons/terminalsAndIcons.xml"))
    etree.XMLSchema(etree.parse(str(SCHEMA))).assertValid(root)
    members = [m.get("variableName") for m in root.iter("TerminalMemberVariable")]
    assert members == ["position", "velocity", "load"]
    assert set(members) < {v.name for v in unpacked_3.description.modelVariables}


SCENES = ("interface", "changing_inputs", "tuned", "burst")


@pytest.mark.isolated  # some scenes judge what an FMU does to its process
@pytest.mark.parametrize("name", SCENES)
def test_scene_passes(native_3_fmu: Path, name: str) -> None:
    (result,) = validate([native_3_fmu], [find_scene(name)])
    assert not result.run_failures
    failed = [(c.quantity, c.fmu, c.reference) for c in result.checks if not c.passed]
    assert not failed, "FMI 3.0 is another shell around the same component"
