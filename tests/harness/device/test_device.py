from __future__ import annotations

import math

import pytest

from slider_resonator.device.device import Device


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


def test_unknown_parameter_is_refused_by_name() -> None:
    with pytest.raises(ValueError, match=r"slider_mas.*0\.5.*slider_mass"):
        Device.from_mapping({"slider_mas": 0.5})


def test_fraction_for_an_integer_is_refused_by_name() -> None:
    with pytest.raises(ValueError, match=r"friction_faces = 1\.5 must be an integer"):
        Device.from_mapping({"friction_faces": 1.5})


@pytest.mark.parametrize("value", [math.nan, math.inf])
def test_nonfinite_integer_is_refused_by_name(value: float) -> None:
    with pytest.raises(ValueError, match="friction_faces"):
        Device.from_mapping({"friction_faces": value})
