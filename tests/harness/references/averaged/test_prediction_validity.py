from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.averaged.device_average import prediction_valid
from slider_resonator.references.equivalent_force import equivalent_force
from slider_resonator.references.resolved.simulate import simulate

TABLE_1 = Device()
CONSTANT_LOAD = replace(TABLE_1, normal_amplitude=0.0, damping_ratio=0.3)
PERIOD = 2.0 * math.pi / TABLE_1.drive_frequency


def stick_fraction(device: Device) -> float:
    """Share of 3 drive periods spent sticking, after 60 from rest."""
    begin, end = (
        simulate(device, [HeldInputs(0.0, stop)], np.array([stop])).stick_time
        for stop in (60.0 * PERIOD, 63.0 * PERIOD)
    )
    return (end - begin) / (3.0 * PERIOD)


def amplitude_at_the_limit(device: Device) -> float:
    """Base amplitude (m) from which on the prediction is valid, by bisection."""
    low, high = 0.0, device.base_amplitude
    for _ in range(40):
        middle = 0.5 * (low + high)
        valid = prediction_valid(replace(device, base_amplitude=middle), 0.0, 0.0, 1.0)
        low, high = (low, middle) if valid else (middle, high)
    return high


@pytest.mark.parametrize("resonator_frequency", [2500.0, 3500.0, 6000.0])
def test_friction_holds_up_to_the_limit(resonator_frequency: float) -> None:
    """Under a constant normal force the slider sticks all the time, or the free one would."""
    device = replace(CONSTANT_LOAD, resonator_frequency=resonator_frequency)
    limit = amplitude_at_the_limit(device)
    below, above = (replace(device, base_amplitude=share * limit) for share in (0.99, 1.01))
    free_force = equivalent_force(below).amplitude
    assert free_force < device.mean_friction or stick_fraction(below) == pytest.approx(1.0)
    assert stick_fraction(above) < 1.0


def test_a_load_of_full_friction_is_the_limit() -> None:
    assert prediction_valid(TABLE_1, 0.0, 0.1999, 1.0)
    assert not prediction_valid(TABLE_1, 0.0, 0.2001, 1.0)
    lifting = replace(TABLE_1, normal_preload=0.0)
    assert prediction_valid(lifting, 0.0, 0.199 / math.pi, 1.0), "its mean over a turn counts"
    assert not prediction_valid(lifting, 0.0, 0.201 / math.pi, 1.0)
    assert prediction_valid(TABLE_1, math.pi / 2.0, 0.39, 0.0), "at ratio 0 the load that stands"


def test_no_vibration_no_prediction() -> None:
    assert not prediction_valid(replace(TABLE_1, base_amplitude=0.0), 0.0, 0.0, 1.0)
    free = math.sqrt(TABLE_1.slider_mass / TABLE_1.total_mass) * TABLE_1.drive_frequency
    resonant = replace(TABLE_1, damping_ratio=0.0, resonator_frequency=free)
    assert not prediction_valid(resonant, 0.0, 0.0, 1.0)
    assert prediction_valid(replace(resonant, resonator_frequency=3500.0), 0.0, 0.0, 1.0)
