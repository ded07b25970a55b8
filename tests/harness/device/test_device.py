from __future__ import annotations

import math

import pytest

from slider_resonator.device.device import Device
from slider_resonator.device.interface import INPUT_STARTS, VARIABLES
from slider_resonator.fmu.opening import Fmu


def test_starts_are_table_1() -> None:
    device = Device()
    assert device.mass_ratio == pytest.approx(1.0 / 11.0), "r_m = m / (m + M) of table 1"
    natural = math.sqrt(device.stiffness / device.resonator_mass)
    assert natural == pytest.approx(3500.0), "table 1 gives (k/m)^(1/2) = 3500 rad/s"
    factor = 0.5 * device.damping / math.sqrt(device.stiffness * device.resonator_mass)
    assert factor == pytest.approx(0.05), "table 1 gives 0.5 c / (k m)^(1/2) = 0.05"


def test_mapping_replaces_only_what_it_names() -> None:
    device = Device.from_mapping({"slider_mass": 2, "friction_faces": 1.0})
    assert device == Device(slider_mass=2.0, friction_faces=1)
    assert isinstance(device.friction_faces, int), "Integer parameters stay integers"


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [
        ("slider_mas", 0.5, r"slider_mas.*0\.5.*slider_mass"),
        ("friction_faces", 1.5, r"friction_faces = 1\.5 must be an integer"),
        ("friction_faces", math.nan, "friction_faces"),
        ("friction_faces", math.inf, "friction_faces"),
    ],
)
def test_wrong_parameter_is_refused_by_name(name: str, value: float, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        Device.from_mapping({name: value})


def test_fmu_has_this_interface_and_these_starts(fmu: Fmu) -> None:
    """The interface is written down twice, in the harness and in the component: both must agree."""
    assert {*fmu.variables, *fmu.lacks} == set(VARIABLES)
    starts = {**vars(Device()), **INPUT_STARTS}
    for name in starts.keys() - set(fmu.lacks):
        start = starts[name]
        assert float(fmu.variables[name].start) == start, name
