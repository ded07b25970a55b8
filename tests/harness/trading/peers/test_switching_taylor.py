"""The fast peer against the references, on motions without sticking."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.resolved.simulate import simulate
from slider_resonator.trading.peers.switching_taylor import device_at, simulate_sliding

MOVING = Device(
    initial_velocity=-0.0491,
    initial_resonator_displacement=-4.978e-4,
    initial_resonator_velocity=1.5837,
)
PERIOD = 2.0 * math.pi / MOVING.drive_frequency


@pytest.mark.parametrize(("law", "accuracy"), [(0, 1e-11), (1, 1e-10)])
def test_it_agrees_with_the_references(law: int, accuracy: float) -> None:
    device = replace(MOVING, friction_law=law, bristle_stiffness=1e4)
    held = HeldInputs(0.0, (20 - 15 * law) * PERIOD, phase=0.2, load=0.01, frequency_ratio=1.5)
    times = np.array([0.0, held.stop])
    reference = (simulate, simulate)[law](device, [held], times)
    assert reference.sticks == 0, "the peer covers no sticking"
    end = simulate_sliding(device, held, times, tolerance=1e-14)
    assert end.reversals == reference.reversals
    for column, name in enumerate(("position", "velocity", "resonator_displacement")):
        expected = getattr(reference, name)[-1]
        assert end.samples[-1, column] == pytest.approx(expected, rel=accuracy), name


def test_devices_that_it_does_not_cover_are_refused() -> None:
    held, times = HeldInputs(0.0, PERIOD), np.array([PERIOD])
    with pytest.raises(ValueError, match="initial_velocity not 0"):
        simulate_sliding(Device(), held, times, tolerance=1e-10)
    with pytest.raises(ValueError, match="the contact lifts"):
        simulate_sliding(replace(MOVING, normal_amplitude=1.5), held, times, tolerance=1e-10)


@pytest.mark.parametrize("law", [0, 1])
def test_a_run_goes_on_from_within_its_inputs(law: int) -> None:
    device = replace(MOVING, friction_law=law, bristle_stiffness=1e4)
    held = HeldInputs(0.0, 6 * PERIOD, phase=0.2, frequency_ratio=1.5)
    times = np.linspace(0.0, held.stop, 25)
    reference = (simulate, simulate)[law](device, [held], times)
    begin = 8
    later = device_at(device, reference, begin)
    end = simulate_sliding(later, held, times[begin:], tolerance=1e-14, start=float(times[begin]))
    assert end.samples[:, 0] == pytest.approx(reference.position[begin:], rel=1e-9)
    assert end.samples[:, 1] == pytest.approx(reference.velocity[begin:], rel=1e-9)
