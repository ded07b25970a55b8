"""Time stepping: first order through reversals, exact at rest."""

import math

import numpy as np
import pytest

from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.resolved.simulate import simulate as resolved
from slider_resonator.references.resolved.trajectory import Trajectory
from slider_resonator.trading.peers.moreau_jean import simulate

PERIOD = 2.0 * math.pi / 3500.0
BLOCK = {"resonator_mass": 0.0, "base_amplitude": 0.0, "normal_amplitude": 0.0}


def test_the_error_falls_with_the_first_power_of_the_step() -> None:
    # Friction so strong that the step in which the slider reverses tells, averaged over where in
    # the step it does.
    device = Device(friction_coefficient=20.0)
    held = [HeldInputs(0.0, 6 * PERIOD)]
    times = np.linspace(0.0, held[0].stop, 7)
    reference = resolved(device, held, times)
    assert reference.reversals > 10
    counts = np.array([61, 251, 1021])
    sizes = np.array(
        [
            np.mean([deviation(device, held, reference, n + odd) for odd in (-4, 0, 4)])
            for n in counts
        ]
    )
    order = -np.polyfit(np.log(counts), np.log(sizes), 1)[0]
    assert order == pytest.approx(1.0, abs=0.1), (
        f"a reversal within a step costs the theta method its second order; errors {sizes}"
    )


def deviation(
    device: Device, held: list[HeldInputs], reference: Trajectory, steps_per_period: int
) -> float:
    run = simulate(device, held, reference.time, steps_per_period=steps_per_period)
    return float(np.abs(run.position - reference.position).max())


def test_a_block_stops_and_then_rests_exactly() -> None:
    device = Device.from_mapping({**BLOCK, "initial_velocity": 0.02})
    times = np.linspace(0.0, 0.2, 41)
    run = simulate(device, [HeldInputs(0.0, 0.2)], times, steps_per_period=8)
    sliding = np.minimum(times, 0.1)
    assert run.position == pytest.approx(0.02 * sliding - 0.1 * sliding**2, abs=1e-6)
    assert (run.velocity[times > 0.101] == 0.0).all(), "friction holds the block, no creep"
    assert (run.friction_force[times > 0.101] == 0.0).all(), "nothing pulls, nothing holds"
    assert run.reversals == 0
    assert (run.contact_mode[times < 0.099] == 1).all()
    assert (run.contact_mode[times > 0.101] == 0).all()
