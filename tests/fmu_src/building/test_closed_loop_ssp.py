from __future__ import annotations

import zipfile
from pathlib import Path

import pytest
from fmpy.ssp.ssd import read_ssd, read_ssv

from fmu_src.building.build_error import BuildError
from fmu_src.building.closed_loop_ssp import PARAMETER_SETS, build_closed_loop


def test_the_package_is_valid_ssp_1_0(closed_loop_package: Path, tmp_path: Path) -> None:
    system = read_ssd(closed_loop_package).system  # checks the schema
    (binding,) = system.parameterBindings
    assert binding.source == "resources/proof.ssv", "without a choice the full device is run"
    with zipfile.ZipFile(closed_loop_package) as archive:
        for component in system.elements:
            assert component.source in archive.namelist(), component.name
        alone = tmp_path / "alone.ssp"
        with zipfile.ZipFile(alone, "w") as other:
            other.writestr("SystemStructure.ssd", archive.read("ComponentsOnly.ssd"))
    without = read_ssd(alone).system
    assert without.connectors == []
    assert len(without.connections) == 2, "the loop itself"


@pytest.mark.parametrize(("name", "fidelity"), PARAMETER_SETS.items())
def test_parameter_sets_differ_in_fidelity_only(
    closed_loop_package: Path, name: str, fidelity: int
) -> None:
    found = read_ssv(closed_loop_package, resource=f"resources/{name}.ssv").parameters
    values = {parameter.name: parameter.value for parameter in found}
    assert values.pop("slider.fidelity") == str(fidelity)
    assert values.pop("controller.sample_time") == "0.01"
    assert {name.partition(".")[0] for name in values} == {"controller"}


def test_every_component_input_is_connected(closed_loop_package: Path) -> None:
    system = read_ssd(closed_loop_package).system
    ends = {(c.endElement, c.endConnector) for c in system.connections}
    for component in system.elements:
        for connector in component.connectors:
            if connector.kind == "input":
                assert (component.name, connector.name) in ends, connector.name


def test_equal_fmus_give_equal_bytes(
    closed_loop_package: Path, native_fmu: Path, controller_fmu: Path, tmp_path: Path
) -> None:
    again = build_closed_loop(tmp_path, native_fmu, controller_fmu)
    assert again.read_bytes() == closed_loop_package.read_bytes()


def test_a_missing_fmu_is_named(native_fmu: Path, tmp_path: Path) -> None:
    with pytest.raises(BuildError, match=r"none\.fmu: no such file; ClosedLoop\.ssp needs it"):
        build_closed_loop(tmp_path, native_fmu, tmp_path / "none.fmu")
    assert list(tmp_path.iterdir()) == []
