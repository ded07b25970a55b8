from __future__ import annotations

from math import pi

import pytest
from hypothesis import given
from hypothesis import strategies as st

from slider_resonator.device.interface import PARAMETERS, VARIABLES
from slider_resonator.device.values import si_value, with_unit


@pytest.mark.parametrize(
    ("name", "text", "value"),
    [
        ("drive_frequency", "20 kHz", 2.0 * pi * 20e3),
        ("drive_frequency", "3000 rpm", 2.0 * pi * 50.0),
        ("drive_frequency", "3500 rad/s", 3500.0),
        ("base_amplitude", "1 um", 1e-6),
        ("base_amplitude", "1 µm", 1e-6),
        ("resonator_mass", "5 g", 5e-3),
        ("phase", "30 deg", pi / 6.0),
        ("load", "0.2N", 0.2),
        ("damping_ratio", "2 %", 0.02),
        ("bristle_stiffness", "0.1 1/um", 1e5),
        ("bristle_damping", "0.01 s/mm", 10.0),
        ("initial_velocity", "-3 mm/s", -3e-3),
        ("load", "1e-3", 1e-3),
    ],
)
def test_text_becomes_si(name: str, text: str, value: float) -> None:
    assert si_value(name, text) == pytest.approx(value, rel=1e-14)


@pytest.mark.parametrize(
    ("name", "text", "said"),
    [
        ("base_amplitude", "3 kg", "not in m; must be a number in m"),
        ("drive_frequency", "20 khz", "unknown unit 'khz'"),
        ("load", "0.2", ""),
        ("load", "9**9**9 N", "such as '200 mN'"),
        ("load", "", "such as '200 mN'"),
        ("load", "1 N^2", "not in N"),
        ("load", "__import__('os')", "such as '200 mN'"),
    ],
)
def test_other_text_is_refused(name: str, text: str, said: str) -> None:
    if not said:
        assert si_value(name, text) == 0.2
        return
    with pytest.raises(ValueError, match=name) as error:
        si_value(name, text)
    assert said in str(error.value)
    assert repr(text) in str(error.value)


@given(st.sampled_from(sorted(PARAMETERS)), st.floats(1e-9, 1e9))
def test_what_is_shown_is_read_back(name: str, value: float) -> None:
    if VARIABLES[name].kind == "Integer":
        return
    assert si_value(name, with_unit(name, value)) == pytest.approx(value, rel=1e-5)
