"""An output that follows a variable which it does not declare is noticed."""

from __future__ import annotations

from pathlib import Path
from xml.etree import ElementTree as ET

import pytest

from slider_resonator.checks.conduct.dependencies import dependency_faults
from slider_resonator.checks.fmu_side import FmuSide
from slider_resonator.fmu.instance import Instance
from slider_resonator.fmu.opening import open_fmu
from tests.harness.faulty_fmus import DESCRIPTION, altered, scene
from tests.harness.scene_text import read_scene

LEFT_OUT = (
    ("Outputs", "steady_velocity", "phase", "in a run"),
    ("Outputs", "blocking_force", "phase", "in a run"),
    ("Outputs", "friction_force", "load", "in a run"),
    ("InitialUnknowns", "steady_velocity", "damping_ratio", "at the start"),
    ("InitialUnknowns", "velocity", "initial_velocity", "at the start"),
)
"""Where a dependency of an output is left out, and when it shows."""


def without_dependency(fmu: Path, out: Path, place: str, output: str, name: str) -> Path:
    """Copy an FMU whose output does not declare that a variable acts on it."""

    def alter(file: str, content: bytes) -> bytes:
        if file != DESCRIPTION:
            return content
        root = ET.fromstring(content)
        variables = enumerate(root.iterfind("ModelVariables/ScalarVariable"), start=1)
        indices = {variable.attrib["name"]: str(index) for index, variable in variables}
        unknown = root.find(f"ModelStructure/{place}/Unknown[@index='{indices[output]}']")
        assert unknown is not None
        others = unknown.attrib["dependencies"].split()
        others.remove(indices[name])
        unknown.set("dependencies", " ".join(others))
        unknown.attrib.pop("dependenciesKind", None)
        return ET.tostring(root)

    return altered(fmu, out, alter)


def faults_of(fmu: Path, folder: Path) -> tuple[str, ...]:
    with open_fmu(fmu) as opened:
        instance = Instance(opened)
        found = dependency_faults(FmuSide(instance, read_scene(scene(folder))))
        instance.end()
    return tuple(found)


@pytest.mark.parametrize(("place", "output", "name", "when"), LEFT_OUT)
def test_a_dependency_that_is_left_out_is_a_fault(
    native_fmu: Path, tmp_path: Path, place: str, output: str, name: str, when: str
) -> None:
    faulty = without_dependency(native_fmu, tmp_path / "faulty.fmu", place, output, name)
    found = faults_of(faulty, tmp_path)
    assert found == (f"{name} acts on {output} {when} without being declared",)
