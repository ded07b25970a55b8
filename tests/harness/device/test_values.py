from __future__ import annotations

from math import inf, nan

import pytest

from slider_resonator.device.device import Device
from slider_resonator.device.interface import INPUTS, INTEGERS, PARAMETERS, VARIABLES, Variable
from slider_resonator.device.values import check_integer, check_value


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [
        ("load", nan, "load = nan: must be a finite number"),
        ("phase", -inf, "phase = -inf: must be a finite number"),
        ("load", 10**400, "load = 1000.*: must be a finite number"),
        ("load", True, "load = True: must be a number"),
        ("friction_law", 10**400, "must be an integer up to 2147483647"),
        ("friction_law", nan, "friction_law = nan: must be an integer"),
        ("fidelity", inf, "fidelity = inf: must be an integer"),
        ("friction_faces", 1.5, "friction_faces = 1.5: must be an integer"),
        ("fidelity", 2.0**32 + 2, "must be an integer up to 2147483647"),
        ("drive_frequency", 0.0, "= 0.0: must be a finite number of at least 1e-06 rad/s"),
        ("slider_mass", 0.0, "slider_mass = 0.0: must be a finite number of at least 1e-12 kg"),
        ("normal_preload", -0.1, "normal_preload = -0.1: must be a finite number of at least 0 N"),
        ("friction_coefficient", -1.0, "= -1.0: must be a finite number of at least 0"),
        ("tolerance", 0.1, "tolerance = 0.1: must be a finite number from 1e-14 to 0.01"),
        ("fidelity", 7.0, "fidelity = 7: must be an integer from 0 to 2"),
        ("friction_faces", 0.0, "friction_faces = 0: must be an integer from 1 to 2"),
    ],
)
def test_invalid_value_is_refused_by_name(name: str, value: float, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        check_value(name, value)


@pytest.mark.parametrize("variable", [VARIABLES[name] for name in (*PARAMETERS, *INPUTS)])
def test_bounds_are_inclusive(variable: Variable) -> None:
    bounds = (variable.minimum, variable.maximum)
    for value in (-1e300 if bounds[0] is None else bounds[0], variable.start):
        assert value is not None
        check_value(variable.name, value)
    if bounds[1] is not None:
        check_value(variable.name, bounds[1])
    elif variable.kind == "Real":
        check_value(variable.name, 1e300)


def test_all_integers_of_fmi_are_allowed() -> None:
    check_integer("n", -(2.0**31 - 1))
    check_integer("n", 2.0**31 - 1)


def test_integers_are_those_of_the_device() -> None:
    device = Device()
    assert {n for n in PARAMETERS if isinstance(getattr(device, n), int)} == INTEGERS
