"""Motion under a load that varies linearly, against closed forms."""

from __future__ import annotations

import math

import numpy as np
import pytest

from tests.fmu.host import Instantiate
from tests.fmus import native_fmu_only

pytestmark = native_fmu_only

BLOCK = {"base_amplitude": 0.0, "normal_amplitude": 0.0, "resonator_mass": 0.0}
"""A slider without resonator or vibration."""


def test_a_growing_load_releases_the_slider_inside_the_step(instantiate: Instantiate) -> None:
    """At rest under 0.2 N of friction; then X = -rate (t - t0)^3 / (6 M)."""
    for direction in (1.0, -1.0):
        instance = instantiate().initialize(**BLOCK)
        instance.ramp(load=0.12 * direction)
        instance.step(2.0)
        released = 0.2 / 0.12
        since = 2.0 - released
        position, velocity, event, mode = instance.get(
            "position", "velocity", "last_event_time", "contact_mode"
        )
        assert event == pytest.approx(released, abs=1e-12)
        assert position == pytest.approx(-direction * 0.12 * since**3 / 6.0, rel=1e-12)
        assert velocity == pytest.approx(-direction * 0.12 * since**2 / 2.0, rel=1e-12)
        assert mode == -direction


def test_a_falling_load_brings_the_slider_to_rest_and_back(instantiate: Instantiate) -> None:
    """It slides under 0.5 N, stops while the load falls, sticks, and is released the other way."""
    instance = instantiate().initialize(**BLOCK, load=0.5)
    instance.ramp(load=-1.0)
    instance.step(2.0)
    # Backwards: v = -0.3 t + t^2 / 2 is 0 at 0.6 s, where the load is -0.1 N and friction holds;
    # released at -0.2 N, at 0.7 s.
    position, event, reversals = instance.get("position", "last_event_time", "reversals")
    assert event == pytest.approx(0.7, abs=1e-12)
    assert position == pytest.approx(-0.15 * 0.36 + 0.216 / 6.0 + 1.3**3 / 6.0, rel=1e-11)
    assert reversals == 1.0


def test_a_resonator_of_any_kind_follows_a_growing_load(instantiate: Instantiate) -> None:
    """Y'' + 2 d Y' + K Y = L t / M while the pair slides freely, without friction and drive."""
    rate, stop = 3.0, 0.02
    for frequency in (1e-3, 10.0, 100.0, 3500.0):
        for damping in (0.0, 0.05, 0.95, 1.0, 3.0, 50.0):
            parameters = {
                "base_amplitude": 0.0,
                "friction_coefficient": 0.0,
                "resonator_frequency": frequency,
                "damping_ratio": damping,
            }
            instance = instantiate().initialize(**parameters)
            instance.ramp(load=rate)
            instance.step(stop)
            displacement, velocity, position, own = instance.get(
                "resonator_displacement", "resonator_velocity", "position", "velocity"
            )
            decay, stiffness = damping * frequency * 1.1, frequency**2 * 1.1
            expected, expected_rate = _response_to_ramp(decay, stiffness, rate, stop)
            assert displacement == pytest.approx(expected, rel=1e-9), (frequency, damping)
            assert velocity == pytest.approx(expected_rate, rel=1e-9), (frequency, damping)
            centre = -rate * stop**3 / 6.6
            assert position == pytest.approx(centre - displacement / 11.0, rel=1e-11)
            assert own == pytest.approx(-rate * stop**2 / 2.2 - velocity / 11.0, rel=1e-11)


def _response_to_ramp(
    decay: float, stiffness: float, slope: float, t: float
) -> tuple[float, float]:
    """By the exponential of the matrix of (y, y', forcing, slope), scaled and squared."""
    matrix = np.zeros((4, 4))
    matrix[0, 1] = matrix[1, 2] = matrix[2, 3] = 1.0
    matrix[1, :2] = -stiffness, -2.0 * decay
    matrix *= t
    halvings = max(0, math.ceil(math.log2(np.abs(matrix).sum(axis=1).max() + 1.0)) + 4)
    # In long double: squaring a stiff matrix would lose the digits that are compared.
    part = (matrix / 2.0**halvings).astype(np.longdouble)
    power, total = np.eye(4, dtype=np.longdouble), np.eye(4, dtype=np.longdouble)
    for k in range(1, 25):
        power[:] = power @ part / k
        total += power
    for _ in range(halvings):
        total[:] = total @ total
    return float(slope * total[0, 3]), float(slope * total[1, 3])
