"""Tunable parameters that change in a run of the resolved reference."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import TunedInputs
from slider_resonator.references.resolved.simulate import simulate


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
