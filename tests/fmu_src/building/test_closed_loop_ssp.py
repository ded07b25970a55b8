import zipfile
from pathlib import Path

import pytest
from fmpy.ssp.ssd import read_ssd, read_ssv

from fmu_src.building.build_error import BuildError
from fmu_src.building.closed_loop_ssp import FIDELITIES, SYSTEM, build_closed_loop
from fmu_src.system_structure import ParameterValues, parameter_set
from studies.hosts.ssp_package import write_with_connectors


@pytest.fixture
def with_connectors(closed_loop_package: Path, tmp_path: Path) -> Path:
    """The package with its other structure as the first."""
    target = tmp_path / "with_connectors.ssp"
    write_with_connectors(str(closed_loop_package), target)
    return target


@pytest.mark.parametrize("structure", ["closed_loop_package", "with_connectors"])
def test_the_package_is_valid_ssp_1_0(structure: str, request: pytest.FixtureRequest) -> None:
    package = request.getfixturevalue(structure)
    system = read_ssd(package).system  # checks the schema
    (binding,) = system.parameterBindings
    assert binding.source == "resources/proof.ssv", "without a choice the full device is run"
    inside = zipfile.ZipFile(package).namelist()
    ends = {(c.endElement, c.endConnector) for c in system.connections}
    for component in system.elements:
        assert component.source in inside, component.name
        inputs = {(component.name, c.name) for c in component.connectors if c.kind == "input"}
        assert inputs <= ends, "every input is connected"


def test_the_first_structure_has_components_only(closed_loop_package: Path) -> None:
    """libcosim and ecos refuse a connection without an element."""
    system = read_ssd(closed_loop_package).system
    assert system.connectors == []
    listed = {c.name: [each.name for each in c.connectors] for c in system.elements}
    assert "load" not in listed["slider"], "fmpy sets listed inputs to 0"
    assert "mean_velocity" in listed["slider"]
    assert [(c.startElement, c.endElement) for c in system.connections] == [
        ("controller", "slider"),
        ("slider", "controller"),
    ]


def test_components_have_the_parameters_of_the_bound_set(closed_loop_package: Path) -> None:
    """libcosim and ecos read these, and not the set of the system."""
    bound = read_ssv(closed_loop_package, resource="resources/proof.ssv").parameters
    assert {(p.name, p.type, p.value, p.unit) for p in bound} >= {
        ("controller.proportional_gain", "Real", "100.0", "s/m"),
        ("controller.effort_limit", "Real", "1.0", "1"),
        ("slider.fidelity", "Integer", "2", None),
    }
    found = {
        f"{component.name}.{p.name}": (p.type, p.value, p.unit)
        for component in read_ssd(closed_loop_package).system.elements
        for binding in component.parameterBindings
        for p in binding.parameterValues[0].parameters
    }
    assert found == {p.name: (p.type, p.value, p.unit) for p in bound}


@pytest.mark.parametrize(("name", "fidelity"), FIDELITIES.items())
def test_parameter_sets_differ_in_fidelity_only(
    closed_loop_package: Path, name: str, fidelity: int
) -> None:
    found = read_ssv(closed_loop_package, resource=f"resources/{name}.ssv").parameters
    values = {parameter.name: parameter.value for parameter in found}
    assert values.pop("slider.fidelity") == str(fidelity)
    assert values.pop("controller.sample_time") == "0.01"
    assert {name.partition(".")[0] for name in values} == {"controller"}


def test_a_missing_fmu_is_named(native_fmu: Path, tmp_path: Path) -> None:
    with pytest.raises(BuildError, match=r"none\.fmu: no such file; ClosedLoop\.ssp needs it"):
        build_closed_loop(tmp_path, native_fmu, tmp_path / "none.fmu")
    assert list(tmp_path.iterdir()) == []


def test_a_parameter_of_nothing_is_an_error() -> None:
    with pytest.raises(KeyError, match="torque"):
        parameter_set(SYSTEM, ParameterValues("fast", {"slider.torque": 1.0}))
