"""What holds for every device and every input, on devices that hypothesis makes up."""

from __future__ import annotations

import itertools
import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from fmu_src.python.slider_component.component import Motion, motion_of
from fmu_src.python.slider_component.contact import LIFTED, STICK
from fmu_src.python.slider_component.device import Device
from fmu_src.python.slider_component.moment import Moment
from fmu_src.python.slider_component.parameters import Inputs
from tests.fmu_src.python.motions import after, begin

ratios = st.one_of(st.sampled_from([1.0, 3.0, 0.0, -1.0, 0.5, 1e-5]), st.floats(-3.0, 3.0))
devices = st.builds(
    Device,
    slider_mass=st.floats(0.02, 3.0),
    resonator_mass=st.floats(0.01, 0.5),
    resonator_frequency=st.floats(30.0, 300.0),
    damping_ratio=st.one_of(st.sampled_from([0.0, 1.0]), st.floats(0.0, 3.0)),
    normal_preload=st.floats(0.1, 2.0),
    normal_amplitude=st.floats(0.0, 3.0),
    base_amplitude=st.floats(0.0, 2e-3),
    drive_frequency=st.floats(50.0, 200.0),
    tangential_force=st.one_of(st.just(0.0), st.floats(-2.0, 2.0)),
    friction_coefficient=st.floats(0.0, 0.8),
    friction_faces=st.sampled_from([1, 2]),
    fidelity=st.sampled_from([1, 2]),
)
inputs = st.builds(
    Inputs,
    phase=st.floats(-math.pi, math.pi),
    load=st.one_of(st.just(0.0), st.floats(-1.0, 1.0)),
    frequency_ratio=ratios,
)
PERIODS = 3.3


def bounded(device: Device) -> bool:
    """At fidelity 1 the steady resonator exists and is not absurdly large."""
    return device.fidelity == 2 or device.damping_ratio > 1e-3


def duration(device: Device) -> float:
    return PERIODS * math.tau / device.drive_frequency


def scale(device: Device, moment: Moment) -> float:
    """Velocity scale of the device [m/s], for tolerances."""
    w = device.drive_frequency
    fast = device.base_amplitude * w * (1.0 + abs(moment.rate)) + abs(moment.velocity)
    forces = device.friction_coefficient * device.friction_faces * (
        device.normal_preload + device.normal_amplitude
    ) + abs(device.tangential_force)
    return fast + forces / device.slider_mass / w + 1e-6


@given(devices, inputs, st.lists(st.floats(0.01, 1.0), min_size=2, max_size=40))
def test_the_partition_into_steps_does_not_matter(
    device: Device, held_inputs: Inputs, parts: list[float]
) -> None:
    assume(bounded(device))
    law, moment = motion_of(device, held_inputs), begin(device, held_inputs)
    whole = law.advance(moment, duration(device))
    for part in parts:
        moment = law.advance(moment, duration(device) * part / sum(parts))
    size = scale(device, whole)
    assert moment.velocity == pytest.approx(whole.velocity, abs=1e-9 * size)
    assert moment.position == pytest.approx(
        whole.position, abs=1e-9 * size / device.drive_frequency
    )
    assert moment.displacement == pytest.approx(
        whole.displacement, rel=1e-9, abs=1e-9 * size / device.drive_frequency
    )


@given(devices, inputs)
def test_mirror_symmetry(device: Device, held_inputs: Inputs) -> None:
    """X(t) solves the equations for (load, phase); then -X(t + T/2) does for (-load, phase + r pi).

    Half a drive period turns both drives around, and advances the normal load by r pi.
    """
    assume(bounded(device))
    half = math.pi / device.drive_frequency
    law = motion_of(device, held_inputs)
    moment = after(half, device, held_inputs)
    mirrored_inputs = Inputs(
        held_inputs.phase + held_inputs.frequency_ratio * math.pi,
        -held_inputs.load,
        held_inputs.frequency_ratio,
    )
    mirrored_law = motion_of(device, mirrored_inputs)
    names = ("velocity", "displacement", "rate", "position")
    state = {name: -getattr(moment, name) for name in names}
    mirrored = begin(device, mirrored_inputs, **state)
    moment = law.advance(moment, duration(device))
    mirrored = mirrored_law.advance(mirrored, duration(device))
    size = scale(device, moment)
    assert mirrored.velocity == pytest.approx(-moment.velocity, abs=1e-9 * size)
    assert mirrored.position == pytest.approx(
        -moment.position, abs=1e-9 * size / device.drive_frequency
    )


@given(devices, inputs)
def test_friction_within_the_limit_and_equal_to_it_in_slip(
    device: Device, held_inputs: Inputs
) -> None:
    assume(bounded(device))
    law = motion_of(device, held_inputs)
    moment = law.start()
    for _ in range(40):
        moment = law.advance(moment, duration(device) / 40)
        mode = law.mode(moment)
        force = law.friction_force(moment, mode)
        limit = law.system.friction_limit(moment.psi)
        slack = 1e-9 * (limit + abs(held_inputs.load) + 1e-3)
        assert abs(force) <= limit + slack, f"friction {force} N exceeds its limit {limit} N"
        if mode == LIFTED:
            assert force == 0.0
        elif mode != STICK:
            assert force == math.copysign(limit, moment.velocity or mode)


@given(devices, st.floats(0.0, 1.0), st.floats(0.0, 0.999), st.floats(-math.pi, math.pi), ratios)
def test_no_motion_below_the_stick_limit(
    device: Device, amplitude: float, share: float, phase: float, ratio: float
) -> None:
    """Without vibration a load below the least friction never moves the slider."""
    device = replace(
        device,
        base_amplitude=0.0,
        tangential_force=0.0,
        normal_amplitude=amplitude * device.normal_preload,
    )
    least = device.friction_faces * device.friction_coefficient * (1.0 - amplitude)
    held_inputs = Inputs(phase, share * least * device.normal_preload, ratio)
    moment = after(10 * duration(device), device, held_inputs)
    assert (moment.position, moment.velocity) == (0.0, 0.0)
    assert moment.reversals == 0


def event_times(law: Motion, moment: Moment, length: float) -> list[float]:
    """Times [s] of all events within `length` [s]: each run reports its last one."""
    later = law.advance(moment, length)
    if later.event_age >= length:
        return []
    last = length - later.event_age
    before = last * (1.0 - 1e-9)
    return ([*event_times(law, moment, before), last]) if before > 0.0 else [last]


@pytest.mark.slow
@given(devices, inputs)
def test_energy_balance_closes(device: Device, held_inputs: Inputs) -> None:
    """Energy gained = work of drives and load, less friction and damper; by Gauss quadrature."""
    device = replace(device, fidelity=2)
    law = motion_of(device, held_inputs)
    first = law.start()
    length = 1.2 * math.tau / device.drive_frequency
    m, big = device.resonator_mass, device.slider_mass
    k = m * device.resonator_frequency**2
    c = 2.0 * device.damping_ratio * m * device.resonator_frequency
    w = device.drive_frequency

    def energy(state: Moment) -> float:
        kinetic = big * state.velocity**2 + m * (state.velocity + state.rate) ** 2
        return 0.5 * (kinetic + k * state.displacement**2)

    def powers(moment: Moment) -> tuple[float, float]:
        v, u = moment.velocity, moment.rate
        mode = law.mode(moment)
        push = device.tangential_force * math.sin(moment.theta) - held_inputs.load
        base = m * device.base_amplitude * w * w * math.sin(moment.theta)
        lost = law.friction_force(moment, mode) * v + c * u * u
        return push * v + base * (v + u) - lost, abs(push * v) + abs(base * (v + u)) + lost

    nodes, weights = np.polynomial.legendre.leggauss(24)
    gained = moved = 0.0
    edges = [0.0, *event_times(law, first, length), length]
    time, moment = 0.0, first
    for left, right in itertools.pairwise(edges):
        parts = max(1, math.ceil((right - left) * 4.0 * max(w, device.resonator_frequency)))
        for i in range(parts):
            a = left + (right - left) * i / parts
            half = 0.5 * (right - left) / parts
            for node, weight in zip(nodes, weights, strict=True):
                here = a + half * (1.0 + float(node))
                time, moment = here, law.advance(moment, here - time)
                net, gross = powers(moment)
                gained += half * float(weight) * net
                moved += half * float(weight) * gross
    balance = energy(law.advance(first, length)) - gained
    assert abs(balance) <= 1e-8 * (moved + 1e-12), f"{balance:.3g} J of {moved:.3g} J unaccounted"
