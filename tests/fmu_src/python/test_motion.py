"""When the contact lifts and touches down, to rounding; scenes judge the motion."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fmu_src.python.slider_component.contact import Window
from fmu_src.python.slider_component.device import Device, flight_window


def window_of(preload: float, amplitude: float) -> Window:
    device = Device(normal_preload=preload, normal_amplitude=amplitude)
    return flight_window(device)


@given(st.floats(0.0, 0.999999), st.floats(-20.0, 20.0))
def test_window_is_where_the_load_would_be_negative(share: float, chi: float) -> None:
    load = share + math.sin(chi)
    if abs(load) > 1e-12:
        assert window_of(share, 1.0).is_lifted(chi, 1.0) == (load < 0.0)


@given(
    st.floats(0.0, 0.999999),
    st.floats(-20.0, 20.0),
    st.one_of(st.floats(0.1, 50.0), st.floats(-50.0, -0.1)),
)
def test_load_is_zero_at_the_next_switch(share: float, chi: float, frequency: float) -> None:
    window = window_of(share, 1.0)
    lifted = window.is_lifted(chi, frequency)
    time = window.time_to_switch(chi, frequency, lifted)
    assert 0.0 <= time <= math.tau / abs(frequency)
    assert share + math.sin(chi + frequency * time) == pytest.approx(0.0, abs=2e-12)
    for part in (0.1, 0.5, 0.9):
        between = chi + frequency * time * part
        if abs(share + math.sin(between)) > 1e-12:
            assert window.is_lifted(between, frequency) == lifted, "a switch was passed over"


@pytest.mark.parametrize("share", [0.0, 0.5])
@pytest.mark.parametrize("past", [-4e-16, 0.0, 4e-16])
def test_on_a_boundary_the_direction_decides(share: float, past: float) -> None:
    window = window_of(share, 1.0)
    first, last = window
    assert window.is_lifted(first + past, 1.0)
    assert not window.is_lifted(last + past, 1.0)
    assert not window.is_lifted(first + past, -1.0)
    assert window.is_lifted(last + past, -1.0)


def test_constant_load_never_switches() -> None:
    assert window_of(0.5, 1.0).time_to_switch(4.0, 0.0, lifted=True) == math.inf
    assert window_of(0.0, 1.0).is_lifted(0.0, 0.0), "a load of zero is flight"
    assert not window_of(0.0, 1.0).is_lifted(0.5, 0.0)


def test_no_normal_load_at_all_is_flight() -> None:
    window = window_of(0.0, 0.0)
    for chi in (0.0, 1.0, 5.0):
        assert window.is_lifted(chi, 1.0)
        assert window.time_to_switch(chi, 1.0, lifted=True) == math.inf
