"""Steady motion on bristles by shooting with the Taylor reference, against averages."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.averaged import device_average
from slider_resonator.references.equivalent_force import equivalent_force
from slider_resonator.references.resolved.simulate import simulate
from slider_resonator.steady.reference_steady import (
    reference_blocking_force,
    reference_steady_velocity,
)
from tests.harness.references.lugre_problems import unit_device

QUICK = (0.1, 10.0)
KAPPAS = [
    pytest.param(kappa, marks=() if kappa in QUICK else pytest.mark.slow)
    for kappa in (0.01, 0.1, 1.0, 10.0, 100.0, 1000.0)
]


def steady_velocity(
    device: Device, phase: float, load: float = 0.0, ratio: float = 1.0, guess: float = 0.0
) -> float:
    found = reference_steady_velocity(device, phase, load, ratio, guess, simulate=simulate)
    assert found is not None, "there is a steady motion"
    return found


def blocking_force(device: Device, phase: float, guess: float) -> float:
    found = reference_blocking_force(device, phase, 1.0, guess, simulate=simulate)
    assert found is not None, "there is a load that stops the device"
    return found


@pytest.mark.slow
@pytest.mark.parametrize("fidelity", [1, 2])
def test_long_run_converges_to_the_steady_motion(fidelity: int) -> None:
    """Strong friction, so that 250 drive periods forget the start."""
    device = Device(friction_law=1, fidelity=fidelity, friction_coefficient=2.0)
    steady = steady_velocity(device, 0.4, 0.1)
    period = 2.0 * math.pi / device.drive_frequency
    times = np.array([250.0, 270.0]) * period
    means = []
    for side in (-1.0, 1.0):
        fast = equivalent_force(device).velocity_amplitude
        start = replace(device, initial_velocity=steady + side * 0.2 * fast - fast)
        run = simulate(start, [HeldInputs(0.0, times[-1], 0.4, 0.1)], times)
        means.append(float(np.diff(run.position)[0]) / (20.0 * period))
    assert means == pytest.approx([steady, steady], abs=1e-4 * fast), "a long run ends there too"


@pytest.mark.parametrize("amplitude_ratio", [0.8, 1.6])
@pytest.mark.parametrize("kappa", KAPPAS)
def test_uniform_average_errors_fall_with_the_frequency(
    kappa: float, amplitude_ratio: float
) -> None:
    """Soft to hard bristles, closed and lifting: velocity and blocking force."""
    errors = []
    for frequency in (1000.0, 4000.0):
        device = unit_device(kappa, frequency, amplitude_ratio)
        velocity = device_average.steady_velocity(device, 1.0, 0.0, 1.0)
        force = device_average.blocking_force(device, 1.0, 1.0)
        errors.append(
            (
                velocity - steady_velocity(device, 1.0, guess=velocity),
                force - blocking_force(device, 1.0, guess=force),
            )
        )
    for coarse, fine in zip(*errors, strict=True):
        assert abs(coarse) < 2e-3, "of v_q, or of N0"
        assert coarse / fine == pytest.approx(4.0, rel=0.02), "averages err by 1 / Omega"


def test_ratio_3_with_the_resonator_matches_the_average() -> None:
    device = Device(friction_law=1)
    average = device_average.steady_velocity(device, 0.4, 0.02, 3.0)
    found = steady_velocity(device, 0.4, 0.02, 3.0, guess=average)
    fast = equivalent_force(device).velocity_amplitude
    assert found == pytest.approx(average, abs=5e-3 * fast)
