"""Tunable parameters that change in a run, in every reference."""

from __future__ import annotations

import math
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs, TunedInputs
from slider_resonator.references.averaged.averaged_motion import simulate_averaged
from slider_resonator.references.resolved.simulate import simulate
from slider_resonator.references.resolved.trajectory import Trajectory
from slider_resonator.trading.peers import event_free, located_scipy

SIGNALS = ("position", "velocity", "resonator_displacement", "normal_force", "friction_force")
TUNED: tuple[tuple[tuple[str, float], ...], ...] = (
    (("normal_preload", 1.0), ("base_amplitude", 1e-4), ("drive_frequency", 3500.0)),
    (("normal_preload", 1.3), ("base_amplitude", 1e-4), ("drive_frequency", 3300.0)),
    (("normal_preload", 1.3), ("base_amplitude", 6e-5), ("drive_frequency", 3600.0)),
)
MU = (0.2, 0.5, 0.3)
EDGES = (0.0, 2.1e-3, 4.7e-3, 7e-3)


def held(*tuned: tuple[tuple[str, float], ...]) -> list[HeldInputs]:
    return [
        TunedInputs(start, stop, phase=0.4, tuned=own)
        for (start, stop), own in zip(pairwise(EDGES), tuned, strict=True)
    ]


def assert_equal(first: Trajectory, second: Trajectory, relative: float) -> None:
    for name in SIGNALS:
        one, other = getattr(first, name), getattr(second, name)
        assert np.abs(one - other).max() <= relative * np.abs(other).max(), name


@pytest.mark.parametrize("law", [0, 1])
def test_tuning_to_the_same_values_is_no_tuning(law: int) -> None:
    device = Device(friction_law=law, bristle_stiffness=1e4, friction_coefficient=0.4)
    times = np.linspace(0.0, EDGES[-1], 30)
    plain = simulate(device, [HeldInputs(0.0, EDGES[-1], phase=0.4)], times)
    assert_equal(simulate(device, held(*[TUNED[0]] * 3), times), plain, 1e-11)


@pytest.mark.parametrize("fidelity", [1, 2])
def test_scipy_agrees(fidelity: int) -> None:
    device = Device(fidelity=fidelity, friction_coefficient=0.4)
    times = np.linspace(0.0, EDGES[-1], 50)
    first = simulate(device, held(*TUNED), times)
    second = located_scipy.simulate(device, held(*TUNED), times)
    assert_equal(first, second, 1e-9)
    assert first.event_times == pytest.approx(second.event_times, abs=1e-11)


def test_scipy_agrees_with_bristles() -> None:
    device = Device(friction_law=1, bristle_stiffness=1e4, initial_bristle_deflection=1e-5)
    friction = [(("friction_coefficient", mu), *own[:2]) for mu, own in zip(MU, TUNED, strict=True)]
    times = np.linspace(0.0, EDGES[-1], 50)
    states = event_free.simulate(device, held(*friction), times)
    assert_equal(simulate(device, held(*friction), times), states, 1e-7)
    across = simulate(device, held(*friction), np.array([2.1e-3 - 1e-9, 2.1e-3 + 1e-9]))
    jump = np.diff(across.bristle_deflection)
    assert np.abs(jump) < 1e-8, "the bristle keeps its deflection when friction is tuned"


def test_a_block_slows_down_by_the_friction_of_the_moment() -> None:
    """M v' = -2 mu N0: 0.2 m/s^2 for one second, 0.6 m/s^2 from then on."""
    block = Device(resonator_mass=0.0, base_amplitude=0.0, normal_amplitude=0.0)
    block = replace(block, drive_frequency=1.0, initial_velocity=0.5)
    inputs = [
        TunedInputs(0.0, 1.0, tuned=(("friction_coefficient", 0.1),)),
        TunedInputs(1.0, 2.0, tuned=(("friction_coefficient", 0.3),)),
    ]
    motion = simulate(block, inputs, np.array([0.5, 1.0, 1.25, 2.0]))
    assert motion.velocity == pytest.approx([0.4, 0.3, 0.15, 0.0], abs=1e-12)
    assert motion.event_times == pytest.approx([1.5]), "0.3 m/s at 0.6 m/s^2"


def test_another_drive_frequency_changes_a_rate_and_no_phase() -> None:
    """Without friction a rigid slider under F sin(theta) has M v = F (1 - cos theta) / w."""
    slider = Device(resonator_mass=0.0, friction_coefficient=0.0, tangential_force=2.0)
    inputs = [
        TunedInputs(0.0, 0.3, tuned=(("drive_frequency", 10.0),)),
        TunedInputs(0.3, 0.6, tuned=(("drive_frequency", 17.0),)),
    ]
    motion = simulate(slider, inputs, np.array([0.3, 0.6]))
    first = 2.0 * (1.0 - math.cos(3.0)) / 10.0
    second = first + 2.0 * (math.cos(3.0) - math.cos(3.0 + 17.0 * 0.3)) / 17.0
    assert motion.velocity == pytest.approx([first, second], rel=1e-12)
    angle = np.array([3.0, 3.0 + 17.0 * 0.3])
    assert motion.normal_force == pytest.approx(np.maximum(0.0, 1.0 + np.sin(angle)))


@pytest.mark.parametrize("at", [0.0501, 0.0504, 0.0507])
def test_averaged_motion_takes_over_what_the_resolved_device_has(at: float) -> None:
    """Whatever the angle at which the drive changes, the slow velocity must be that of the pair."""
    device = Device(damping_ratio=0.2)
    inputs = [
        TunedInputs(0.0, at, tuned=(("base_amplitude", 1e-4), ("drive_frequency", 3500.0))),
        TunedInputs(at, 0.15, tuned=(("base_amplitude", 5e-5), ("drive_frequency", 3200.0))),
    ]
    period = 2.0 * math.pi / 3200.0
    times = 0.15 - np.array([1.0, 0.0]) * period
    resolved = simulate(device, inputs, times)
    mean = float(np.diff(resolved.position)[0]) / period
    averaged = simulate_averaged(device, inputs, times)
    jump = 0.1 * 3500.0 * 5e-5 / 1.1
    assert float(averaged.mean_velocity.mean()) == pytest.approx(mean, abs=0.03 * jump)


def test_motion_is_read_before_and_after_a_change_of_the_drive() -> None:
    device = Device(fidelity=0)
    inputs = [
        TunedInputs(0.0, 0.01, tuned=(("base_amplitude", 1e-4),)),
        TunedInputs(0.01, 0.02, tuned=(("base_amplitude", 5e-5),)),
    ]
    times = np.array([0.01, np.nextafter(0.01, 1.0), 0.01 + 1e-9])
    motion = simulate_averaged(device, inputs, times)
    assert motion.position[1] == motion.position[0]
    assert motion.velocity[1] == motion.velocity[0], "nothing jumps when a value is set"
    assert motion.velocity[2] != pytest.approx(motion.velocity[0]), "then the fast motion is new"
