"""The interface is written down twice, in the harness and in the component: both must agree."""

from __future__ import annotations

from slider_resonator.device.device import Device
from slider_resonator.device.interface import INPUT_STARTS, INPUTS, OUTPUTS, PARAMETERS
from slider_resonator.fmu.opening import Fmu


def test_fmu_has_exactly_these_variables(fmu: Fmu) -> None:
    assert set(fmu.variables) == {*INPUTS, *PARAMETERS, *OUTPUTS}


def test_starts_of_the_fmu_are_table_1(fmu: Fmu) -> None:
    for name in PARAMETERS:
        assert float(fmu.variables[name].start) == getattr(Device(), name), name
    for name, start in INPUT_STARTS.items():
        assert float(fmu.variables[name].start) == start, name
