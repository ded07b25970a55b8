from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import pytest

from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.averaged.averaged_motion import simulate_averaged
from slider_resonator.references.averaged.held_orbit import HeldOrbit, held_orbit
from slider_resonator.references.averaged.hold import Hold
from slider_resonator.references.averaged.slow_motion_second_order import (
    momentum_velocity,
    simulate_slow_motion,
    slow_start,
)
from slider_resonator.references.resolved import lugre_taylor, taylor

TURN = 2.0 * np.pi
TABLE_1 = Device()
MU_1 = replace(TABLE_1, friction_coefficient=1.0)
MU_5 = replace(TABLE_1, friction_coefficient=5.0)
BRISTLES = replace(TABLE_1, friction_law=1)


@dataclass(frozen=True)
class Errors:
    """Largest errors against resolved motion: W, X' and position, and W of the first order."""

    momentum: float
    velocity: float
    position: float
    first_order: float


def on_orbit(device: Device, velocity: float, inputs: HeldInputs) -> Device:
    """The device with the initial values of a held orbit."""
    turns = 2 if inputs.frequency_ratio == 1.5 else 1
    ratio = round(turns * inputs.frequency_ratio) / turns
    hold = Hold(device, velocity, inputs.phase, ratio, turns)
    orbit: HeldOrbit = held_orbit(hold)
    origin = np.zeros(1)
    return replace(
        device,
        initial_velocity=float(orbit.panels.at(orbit.slider_velocity, origin)[0]),
        initial_resonator_displacement=float(
            orbit.panels.at(orbit.resonator_displacement, origin)[0]
        ),
        initial_resonator_velocity=float(orbit.panels.at(orbit.resonator_velocity, origin)[0]),
    )


def errors(
    device: Device, held: Sequence[HeldInputs], *, resolved_turns: int = 0, samples: int = 12
) -> Errors:
    """Errors over inputs in whole turns of the drive, after a start that is resolved."""
    period = TURN / device.drive_frequency
    stop = held[-1].stop
    turns = np.unique(np.round(np.linspace(resolved_turns, stop / period, samples + 1)))
    times = np.minimum(turns * period, stop)
    simulate = lugre_taylor.simulate_lugre if device.friction_law else taylor.simulate
    resolved = simulate(device, held, times)
    state = (
        float(resolved.position[0]),
        float(resolved.velocity[0]),
        float(resolved.resonator_displacement[0]),
        float(resolved.resonator_velocity[0]),
    )
    later = [replace(held[0], start=float(times[0])), *held[1:]]
    slow = simulate_slow_motion(device, later, times, start=slow_start(device, state))
    theta = device.drive_frequency * times
    exact, found = (
        momentum_velocity(device, motion.velocity, motion.resonator_velocity, theta)
        for motion in (resolved, slow)
    )
    averaged = simulate_averaged(replace(device, fidelity=0), held, times)
    return Errors(
        momentum=float(np.abs(found - exact).max()),
        velocity=float(np.abs(slow.velocity - resolved.velocity).max()),
        position=float(np.abs(slow.position - resolved.position).max()),
        first_order=float(np.abs(averaged.mean_velocity - exact)[1:].max()),
    )


def held_for(turns: int, **inputs: float) -> list[HeldInputs]:
    return [HeldInputs(0.0, turns * TURN / 3500.0, **inputs)]


@pytest.mark.parametrize(
    ("device", "inputs", "turns", "limit"),
    [
        pytest.param(TABLE_1, {}, 400, 2e-9, id="table 1"),
        pytest.param(TABLE_1, {}, 3200, 3e-9, id="table 1, long", marks=pytest.mark.slow),
        pytest.param(MU_1, {}, 120, 2e-7, id="mu 1"),
        pytest.param(MU_1, {}, 600, 2e-7, id="mu 1, long", marks=pytest.mark.slow),
        pytest.param(MU_5, {}, 60, 1e-5, id="mu 5"),
        pytest.param(MU_1, {"phase": 0.7, "load": 0.3}, 120, 2e-7, id="loaded"),
        pytest.param(
            replace(MU_1, normal_amplitude=1.8),
            {"phase": 0.7, "load": 0.3},
            120,
            7e-7,
            id="flight",
        ),
        pytest.param(MU_1, {"frequency_ratio": 3.0, "phase": 0.7}, 120, 2e-7, id="ratio 3"),
        *(
            pytest.param(
                MU_1,
                {"frequency_ratio": 1.0 + detuning},
                300,
                limit,
                id=f"detuned by {detuning}",
                marks=pytest.mark.slow,
            )
            for detuning, limit in ((1e-4, 4e-7), (1e-3, 4e-6), (5e-3, 3e-6))
        ),
    ],
)
def test_the_slow_motion_is_far_closer_than_the_first_order(
    device: Device, inputs: dict[str, float], turns: int, limit: float
) -> None:
    held = held_for(turns, **inputs)
    found = errors(on_orbit(device, 0.0, held[0]), held)
    assert found.momentum < limit
    assert found.position < limit * turns * TURN / 3500.0 + 3e-7
    assert found.momentum < 0.01 * found.first_order


def at_factor(factor: float, device: Device) -> Device:
    """The device at a higher drive frequency: fast velocity and slow motion stay."""
    return replace(
        device,
        base_amplitude=device.base_amplitude / factor,
        drive_frequency=device.drive_frequency * factor,
        resonator_frequency=device.resonator_frequency * factor,
    )


def test_the_error_is_of_second_order_in_the_drive_frequency() -> None:
    found = []
    for factor in (1.0, 4.0):
        held = held_for(40, phase=0.7)
        device = at_factor(factor, MU_1)
        found.append(errors(on_orbit(device, 0.0, held[0]), held, samples=20))
    slow, first = (
        np.log(getattr(found[0], name) / getattr(found[1], name)) / np.log(4.0)
        for name in ("momentum", "first_order")
    )
    assert slow == pytest.approx(2.0, abs=0.3)
    assert first == pytest.approx(1.0, abs=0.2)


@pytest.mark.parametrize(
    ("device", "limit"),
    [
        pytest.param(TABLE_1, 6e-9, id="table 1"),
        pytest.param(MU_1, 4e-7, id="mu 1"),
    ],
)
def test_after_a_resolved_start_from_rest(device: Device, limit: float) -> None:
    found = errors(device, held_for(300), resolved_turns=20)
    assert found.momentum < limit
    assert found.position < 1e-7


def test_a_resonator_near_its_resonance_adds_mass_too() -> None:
    device = Device(
        resonator_mass=0.5,
        resonator_frequency=3035.0,
        damping_ratio=0.019,
        normal_preload=139.0,
        normal_amplitude=225.0,
    )
    inputs = {"phase": -2.5, "load": 8.0}
    start = on_orbit(device, 0.7, held_for(1, **inputs)[0])
    found = errors(start, held_for(120, **inputs), resolved_turns=40, samples=6)
    assert found.momentum < 1e-5 * Hold(device, 0.0).vibration.velocity_amplitude


@pytest.mark.slow
def test_table_1_from_rest_over_9_seconds() -> None:
    found = errors(TABLE_1, held_for(5000), resolved_turns=20)
    assert found.momentum < 1.3e-8
    assert found.position < 9e-8


@pytest.mark.parametrize(
    ("stiffness", "limit"),
    [
        (1e2, 3e-4),
        (1e3, 5e-6),
        pytest.param(1e4, 6e-8, marks=pytest.mark.slow),
        (1e5, 4e-8),
        pytest.param(1e7, 4e-8, marks=pytest.mark.slow),
    ],
)
def test_bristles_need_the_added_mass(stiffness: float, limit: float) -> None:
    device = replace(BRISTLES, bristle_stiffness=stiffness)
    found = errors(device, held_for(300), resolved_turns=80, samples=6)
    assert found.momentum < limit * Hold(device, 0.0).vibration.velocity_amplitude


@pytest.mark.parametrize(
    ("device", "limit", "count"),
    [
        pytest.param(TABLE_1, 1e-7, 4, id="table 1, short"),
        pytest.param(TABLE_1, 1e-7, 60, id="table 1", marks=pytest.mark.slow),
        pytest.param(MU_1, 5e-6, 60, id="mu 1", marks=pytest.mark.slow),
    ],
)
def test_inputs_that_jump(device: Device, limit: float, count: int) -> None:
    loads = 0.06 * device.friction_coefficient * np.array([1.0, -0.7, 0.2, -1.0, 0.5])
    stretch = 50 * TURN / 3500.0
    held = [
        HeldInputs(index * stretch, (index + 1) * stretch, float(index % 2), loads[index % 5])
        for index in range(count)
    ]
    assert errors(on_orbit(device, 0.0, held[0]), held, samples=count).momentum < limit


@pytest.mark.slow
def test_a_load_that_repeats_after_two_turns_and_inputs_cut_after_one() -> None:
    device = replace(MU_1, normal_amplitude=1.8)
    period = TURN / device.drive_frequency
    whole = held_for(60, frequency_ratio=1.5, phase=0.7)[0]
    cut = [replace(whole, stop=21 * period), replace(whole, start=21 * period, load=0.2)]
    found = errors(on_orbit(device, 0.0, whole), cut, samples=60)
    assert found.momentum < 1e-6
    assert found.momentum < 0.01 * found.first_order


def test_what_has_no_slow_phase_is_refused() -> None:
    times = np.array([1.0])
    with pytest.raises(ValueError, match=r"frequency_ratio = 1\.37"):
        simulate_slow_motion(TABLE_1, [HeldInputs(0.0, 1.0, frequency_ratio=1.37)], times)
    undamped = replace(TABLE_1, damping_ratio=0.0, resonator_frequency=2000.0)
    with pytest.raises(ValueError, match=r"damping_ratio = 0\.0"):
        simulate_slow_motion(undamped, [HeldInputs(0.0, 1.0)], times)
