import math
from dataclasses import replace

import numpy as np
import pytest

from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.averaged.device_average import blocking_force, steady_velocity
from slider_resonator.references.equivalent_force import equivalent_force
from slider_resonator.references.resolved.simulate import simulate

TABLE_1 = Device()


def test_table_1_figures() -> None:
    force = equivalent_force(TABLE_1)
    assert force.amplitude == pytest.approx(910.947, abs=5e-4), "F_T* in N"
    assert force.angle == pytest.approx(0.733313, abs=5e-7), "phi = theta1 in rad at phase 0"
    assert force.ripple_amplitude == pytest.approx(67.603e-6, abs=5e-10), "ripple in m"
    velocity = steady_velocity(TABLE_1, 0.0, 0.0, 1.0)
    assert velocity == pytest.approx(0.126731, abs=5e-7), "steady velocity of (5) in m/s"
    blocking = blocking_force(TABLE_1, 0.0, 1.0)
    assert blocking == pytest.approx(0.085222, abs=5e-7), "blocking force of both faces in N"


@pytest.mark.parametrize(
    "device",
    [
        TABLE_1,
        replace(TABLE_1, resonator_frequency=1500.0),
        replace(TABLE_1, resonator_frequency=6000.0, damping_ratio=0.4),
        replace(TABLE_1, tangential_force=300.0),
        replace(TABLE_1, tangential_force=2000.0, base_amplitude=0.0),
        replace(TABLE_1, resonator_frequency=1500.0, damping_ratio=0.0, tangential_force=-50.0),
    ],
    ids=["table 1", "above resonance", "damped", "both drives", "direct drive", "undamped"],
)
def test_equivalent_force_matches_the_frictionless_device(device: Device) -> None:
    """Fig. 6 without friction, from the claimed steady state on: it must stay in it."""
    force = equivalent_force(device)
    frequency, turned = device.drive_frequency, -force.resonator_angle
    steady = replace(
        device,
        friction_coefficient=0.0,
        initial_velocity=-force.velocity_amplitude * math.cos(force.angle),
        initial_resonator_displacement=force.resonator_amplitude * math.sin(turned),
        initial_resonator_velocity=frequency * force.resonator_amplitude * math.cos(turned),
    )
    times = np.linspace(0.0, 6.0 * math.pi / frequency, 50)
    run = simulate(steady, [HeldInputs(0.0, times[-1])], times)
    velocity = -force.velocity_amplitude * np.cos(frequency * times - force.angle)
    allowed = 1e-7 * force.velocity_amplitude
    assert run.velocity == pytest.approx(velocity, abs=allowed), "as under F_T* alone, (33)"
    resonator = force.resonator_amplitude * np.sin(frequency * times + turned)
    allowed = 1e-7 * abs(force.resonator_amplitude)
    assert run.resonator_displacement == pytest.approx(resonator, abs=allowed), "as (32) says"
