"""Closed forms, series, contact and quadratures of the Python component."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fmu_src.python.slider_component import mean_friction
from fmu_src.python.slider_component.contact import (
    BACKWARD,
    FORWARD,
    LIFTED,
    STICK,
    NormalLoad,
    VibratingLoad,
)
from fmu_src.python.slider_component.device import Device, Oscillator, System
from fmu_src.python.slider_component.mean_friction import MAX_WAVES, NODES, MeanFriction, fejer
from fmu_src.python.slider_component.moment import Moment
from fmu_src.python.slider_component.parameters import Inputs
from fmu_src.python.slider_component.segment import ClosedForm, Series

W = 40.0


def test_what_loses_digits_does_not_split() -> None:
    assert not Oscillator(W, W * W).splits(W), "critical damping"
    assert not Oscillator(0.0, W * W).splits(W, 3.0 * W), "resonance"
    assert not Oscillator(0.1, 0.1).splits(W), "a soft spring"
    assert Oscillator(0.05 * W, W * W).splits(W, -W, 0.0)
    assert Oscillator(0.0, W * W).transfer(2.0 * W) == pytest.approx(-1.0 / (3.0 * W * W))
    assert math.isclose(Oscillator(0.1, W * W).frequency, W)


@pytest.mark.parametrize("ratio", [1.37, -1.0, 0.0])
@pytest.mark.parametrize("mode", [FORWARD, BACKWARD, LIFTED, STICK])
@pytest.mark.parametrize("damping", [0.025, 0.6, 2.0])
def test_exponentials_and_series_agree(ratio: float, mode: int, damping: float) -> None:
    device = Device(damping_ratio=damping, tangential_force=3.0)
    system = System(device, Inputs(phase=0.3, load=0.02, frequency_ratio=ratio))
    velocity = 0.1 * mode if mode != LIFTED else 0.1
    now = Moment(velocity, 2e-4, -1.1, 0.0, theta=1.0, psi=1.7, mode=mode)
    direction = 0 if mode == LIFTED else mode
    fast = ClosedForm(system, now, direction)
    slow = Series(system, now, direction)
    assert slow.reach > 1e-5
    for t in (1e-7, 0.5 * slow.reach, slow.reach):
        assert fast.at(t) == pytest.approx(slow.at(t), rel=1e-12, abs=1e-14)
        for a, b in zip(fast.watches(t), slow.watches(t), strict=True):
            value, slope, bound = a.signal(t)
            assert (value, slope) == pytest.approx(b.signal(t)[:2], rel=1e-11, abs=1e-9)
            before = a.signal(0.9 * t)[1]
            assert abs(slope - before) <= 1.001 * a.signal(0.9 * t)[2] * 0.1 * t + 1e-9 * bound


@given(
    st.floats(0.0, 0.999999),
    st.floats(-20.0, 20.0),
    st.one_of(st.floats(0.1, 50.0), st.floats(-50.0, -0.1)),
)
def test_load_is_zero_at_the_next_switch(share: float, chi: float, frequency: float) -> None:
    contact = NormalLoad(share, 1.0)
    lifted, load = contact.is_lifted(chi, frequency), share + math.sin(chi)
    assert lifted == (load < 0.0) or abs(load) <= 1e-12, "it lifts where the load would be negative"
    time = contact.time_to_switch(chi, frequency, lifted)
    assert 0.0 <= time <= math.tau / abs(frequency)
    assert share + math.sin(chi + frequency * time) == pytest.approx(0.0, abs=2e-12)
    for part in (0.1, 0.5, 0.9):
        between = chi + frequency * time * part
        if abs(share + math.sin(between)) > 1e-12:
            assert contact.is_lifted(between, frequency) == lifted, "a switch was passed over"


@pytest.mark.parametrize("share", [0.0, 0.5])
@pytest.mark.parametrize("past", [-4e-16, 0.0, 4e-16])
def test_on_a_boundary_the_direction_decides(share: float, past: float) -> None:
    contact = NormalLoad(share, 1.0)
    first, last = math.pi + contact.dip, math.tau - contact.dip
    assert contact.is_lifted(first + past, 1.0)
    assert not contact.is_lifted(last + past, 1.0)
    assert not contact.is_lifted(first + past, -1.0)
    assert contact.is_lifted(last + past, -1.0)


@pytest.mark.parametrize("stiffness", [1e2, 1e6, 1e10])
@pytest.mark.parametrize("n", [0.0, 1.0, 17.0])
def test_twice_the_nodes_change_no_mean(
    monkeypatch: pytest.MonkeyPatch, stiffness: float, n: float
) -> None:
    device = Device(
        friction_law=1, friction_faces=1, bristle_stiffness=stiffness, bristle_damping=0.01
    )
    friction = MeanFriction(device, 0.2366)
    load = VibratingLoad(NormalLoad(1.0, 1.5), n, 0.7)
    turnings = (1e-3, 0.3, 1.1, 2.0, 3.1)
    means = [friction.mean(load, turning) for turning in turnings]
    monkeypatch.setattr(mean_friction, "_RULE", fejer(2 * NODES))
    finer = [friction.mean(load, turning) for turning in turnings]
    assert means == pytest.approx(finer, abs=1e-12 * 0.1)


def test_beyond_a_thousand_waves_only_the_mean_counts() -> None:
    friction = MeanFriction(Device(friction_law=1, friction_faces=1, bristle_stiffness=1e4), 0.2366)
    contact, most = NormalLoad(1.0, 1.0), friction.max_waves
    counted, beyond = (
        friction.mean(VibratingLoad(contact, float(MAX_WAVES + more), 0.4, most), 1.1)
        for more in (0, 1)
    )
    constant = VibratingLoad(NormalLoad(contact.mean, 0.0), 1.0, 0.0)
    assert beyond == pytest.approx(friction.mean(constant, 1.1), abs=1e-13)
    assert 0.0 < abs(counted - beyond) < 1e-3 * friction.coefficient


def test_constant_load_never_switches() -> None:
    assert NormalLoad(0.5, 1.0).time_to_switch(4.0, 0.0, lifted=True) == math.inf
    assert NormalLoad(0.0, 1.0).is_lifted(0.0, 0.0), "a load of zero is flight"
    assert not NormalLoad(0.0, 1.0).is_lifted(0.5, 0.0)
    for chi in (0.0, 1.0, 5.0):
        assert NormalLoad(0.0, 0.0).is_lifted(chi, 1.0), "no normal load at all, too"
        assert NormalLoad(0.0, 0.0).time_to_switch(chi, 1.0, lifted=True) == math.inf
