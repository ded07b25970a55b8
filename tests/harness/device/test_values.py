import math
from math import inf, pi
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from slider_resonator.device.device import Device
from slider_resonator.device.interface import INPUT_STARTS, INPUTS, PARAMETERS, VARIABLES
from slider_resonator.device.variable import Variable
from slider_resonator.fmu.opening import Fmu


@pytest.mark.parametrize(
    ("name", "value", "said"),
    [
        ("load", 10**400, "load = 1000"),
        ("friction_law", 10**400, "must be an integer up to 2147483647"),
        ("fidelity", inf, "fidelity = inf: must be an integer"),
        ("fidelity", 2.0**32 + 2, "must be an integer up to 2147483647"),
        ("tolerance", 0.1, "tolerance = 0.1: must be a finite number from 1e-14 to 0.01"),
        ("drive_frequency", "20 khz", "unknown unit 'khz'"),
        ("slider_mass", "50 gr", "unknown unit 'gr'"),
        (
            "load",
            "9**9**9 N",
            "load = '9**9**9 N': must be a number in N, or a text with a unit",
        ),
        ("load", "", "load = '': must be a number in N, or a text with a unit such as '200 mN'"),
        ("load", "1 N^2", "load = '1 N^2': not in N"),
        ("load", "__import__('os')", "such as '200 mN'"),
    ],
)
def test_invalid_value_is_refused_by_name(name: str, value: Any, said: str) -> None:
    """Others are among the mistakes in files and in commands."""
    variable = VARIABLES[name]
    with pytest.raises(ValueError, match=name) as error:
        variable.in_si(value) if isinstance(value, str) else variable.checked(value)
    assert said in str(error.value)


@pytest.mark.parametrize("variable", [VARIABLES[name] for name in (*PARAMETERS, *INPUTS)])
def test_bounds_are_inclusive(variable: Variable) -> None:
    bounds = (variable.minimum, variable.maximum)
    for value in (-1e300 if bounds[0] is None else bounds[0], variable.start):
        assert value is not None
        variable.checked(value)
    if bounds[1] is not None:
        variable.checked(bounds[1])
    elif variable.kind == "Real":
        variable.checked(1e300)


@pytest.mark.parametrize(
    ("name", "text", "value"),
    [
        ("drive_frequency", "20 kHz", 2.0 * pi * 20e3),
        ("drive_frequency", "3000 rpm", 2.0 * pi * 50.0),
        ("base_amplitude", "1 um", 1e-6),
        ("base_amplitude", "1 µm", 1e-6),
        ("resonator_mass", "5 g", 5e-3),
        ("phase", "30 deg", pi / 6.0),
        ("load", "0.2N", 0.2),
        ("load", "0.2", 0.2),
        ("damping_ratio", "2 %", 0.02),
        ("bristle_stiffness", "0.1 1/um", 1e5),
        ("bristle_damping", "0.01 s/mm", 10.0),
        ("initial_velocity", "-3 mm/s", -3e-3),
        ("load", "1e-3", 1e-3),
    ],
)
def test_text_becomes_si(name: str, text: str, value: float) -> None:
    assert VARIABLES[name].in_si(text) == pytest.approx(value, rel=1e-14)


REAL = [name for name in sorted(PARAMETERS) if VARIABLES[name].kind == "Real"]


@given(st.sampled_from(REAL), st.floats(1e-9, 1e9))
def test_what_is_shown_is_read_back(name: str, value: float) -> None:
    assert VARIABLES[name].in_si(VARIABLES[name].shown(value)) == pytest.approx(value, rel=1e-5)


def test_starts_are_table_1() -> None:
    device = Device()
    assert device.mass_ratio == pytest.approx(1.0 / 11.0), "r_m = m / (m + M) of table 1"
    natural = math.sqrt(device.stiffness / device.resonator_mass)
    assert natural == pytest.approx(3500.0), "table 1 gives (k/m)^(1/2) = 3500 rad/s"
    factor = 0.5 * device.damping / math.sqrt(device.stiffness * device.resonator_mass)
    assert factor == pytest.approx(0.05), "table 1 gives 0.5 c / (k m)^(1/2) = 0.05"


def test_fmu_has_this_interface_and_these_starts(fmu: Fmu) -> None:
    """The interface is written down twice, in the harness and in the component: both must agree."""
    assert {*fmu.variables, *fmu.lacks} == set(VARIABLES)
    starts = {**vars(Device()), **INPUT_STARTS}
    for name in starts.keys() - set(fmu.lacks):
        start = starts[name]
        assert float(fmu.variables[name].start) == start, name


def test_a_drive_may_deviate_beyond_what_a_parameter_can_say() -> None:
    slow = Device.from_mapping({"drive_frequency": 1e-5, "frequency_deviation": -0.95})
    assert slow.tuned([("fidelity", 1)]).drive_frequency == pytest.approx(5e-7)
