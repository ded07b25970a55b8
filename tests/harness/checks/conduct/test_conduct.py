"""Faults of conduct are found and named."""

from pathlib import Path
from types import SimpleNamespace
from typing import cast
from xml.etree import ElementTree as ET

import numpy as np
import pytest
from fmpy.fmi1 import FMICallException

from slider_resonator.checks.conduct.dependencies import dependency_faults
from slider_resonator.checks.conduct.findings import differences
from slider_resonator.checks.conduct.host_calls import derivative_offer_faults
from slider_resonator.checks.conduct.refusals import Trial
from slider_resonator.checks.fmu_side import FmuSide
from slider_resonator.fmu.instance import Instance
from slider_resonator.fmu.opening import open_fmu
from tests.harness.faulty_fmus import DESCRIPTION, altered, redescribed, scene
from tests.harness.scene_text import read_scene

LEFT_OUT = (
    ("Outputs", "steady_velocity", "phase", "in a run"),
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


def faults_of(fmu: Path, folder: Path) -> list[str]:
    with open_fmu(fmu) as opened:
        instance = Instance(opened)
        found = dependency_faults(FmuSide(instance, read_scene(scene(folder))))
        instance.end()
    return found


@pytest.mark.parametrize(("place", "output", "name", "when"), LEFT_OUT)
def test_a_dependency_that_is_left_out_is_a_fault(
    native_fmu: Path, tmp_path: Path, place: str, output: str, name: str, when: str
) -> None:
    faulty = without_dependency(native_fmu, tmp_path / "faulty.fmu", place, output, name)
    found = faults_of(faulty, tmp_path)
    assert found == [f"{name} acts on {output} {when} without being declared"]


TIMES = np.array([0.0, 0.5, 1.0])
ROWS = [[1.0, 2.0], [3.0, 4.0], [5.0, 6.0]]


def test_the_last_bit_counts() -> None:
    other = [*ROWS[:2], [float(np.nextafter(5.0, 6.0)), 6.0]]
    found = differences("replayed", ("a", "b"), TIMES, other, ROWS)
    assert found == ["replayed: a at 1 s is 5.000000000000001, was 5.0"]


def test_nan_is_a_difference() -> None:
    nan = [[float("nan"), 2.0], *ROWS[1:]]
    assert len(differences("x", ("a", "b"), TIMES, nan, ROWS)) == 1


OFFERS = {
    "providesDirectionalDerivative": ("false", "true"),
    "maxOutputDerivativeOrder": ("1", "2"),
}


@pytest.mark.parametrize("offer", OFFERS)
def test_a_false_offer_is_a_fault(native_fmu: Path, tmp_path: Path, offer: str) -> None:
    true, false = (f'{offer}="{value}"'.encode() for value in OFFERS[offer])
    found = []
    for path in (native_fmu, redescribed(native_fmu, tmp_path / "other.fmu", true, false)):
        with open_fmu(path) as fmu:
            instance = Instance(fmu)
            instance.start({})
            found.append([*derivative_offer_faults(instance)])
            instance.end()
    sound, (fault,) = found
    assert sound == []
    assert fault.startswith(f"{offer} is {OFFERS[offer][1]}")


@pytest.mark.parametrize(
    ("function", "number", "status"),
    [
        ("fmi2DoStep", 2, "fmi2Discard"),
        ("fmi3DoStep", 2, "fmi3Discard"),
        ("fmi2DoStep", 4, "fmi2Fatal"),
    ],
)
def test_a_status_that_ends_a_run_is_a_fault_by_the_name_of_its_version(
    function: str, number: int, status: str
) -> None:
    fmu = SimpleNamespace(variables={}, runs_without_python=True)
    instance = SimpleNamespace(messages=[], fmu=fmu, read=lambda names: {})
    trial = Trial(cast(Instance, instance), [])

    def refused() -> None:
        raise FMICallException(function=function, status=number)

    trial.refuses("a step", refused)
    assert trial.faults == [f"a step gives {status}, at which hosts end a run"]
