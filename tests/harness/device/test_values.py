from __future__ import annotations

from math import inf, nan

import pytest

from slider_resonator.device.device import Device
from slider_resonator.device.interface import INTEGERS, PARAMETERS
from slider_resonator.device.values import check_integer, check_value


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [
        ("load", nan, "load = nan: must be a finite number"),
        ("phase", -inf, "phase = -inf: must be a finite number"),
        ("friction_law", nan, "friction_law = nan: must be an integer"),
        ("fidelity", inf, "fidelity = inf: must be an integer"),
        ("friction_faces", 1.5, "friction_faces = 1.5: must be an integer"),
        ("fidelity", 2.0**32 + 2, "must be an integer up to 2147483647"),
        ("drive_frequency", 0.0, "drive_frequency = 0.0: must be a number above 0"),
        ("slider_mass", 0.0, "slider_mass = 0.0: must be a number above 0"),
        ("resonator_frequency", -1.0, "resonator_frequency = -1.0: must be a number above 0"),
        ("resonator_mass", -0.1, "resonator_mass = -0.1: must be a number from 0 on"),
        ("normal_preload", -0.1, "normal_preload = -0.1: must be a number from 0 on"),
    ],
)
def test_invalid_value_is_refused_by_name(name: str, value: float, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        check_value(name, value)


def test_other_ranges_are_not_checked() -> None:
    check_value("friction_coefficient", -1.0)
    check_value("normal_preload", 0.0)
    check_value("fidelity", 7.0)
    check_value("load", 1e300)


def test_all_integers_of_fmi_are_allowed() -> None:
    check_integer("n", -(2.0**31 - 1))
    check_integer("n", 2.0**31 - 1)


def test_integers_are_those_of_the_device() -> None:
    device = Device()
    assert {n for n in PARAMETERS if isinstance(getattr(device, n), int)} == INTEGERS
