"""Motion under inputs that vary linearly, against held inputs and a closed form."""

from __future__ import annotations

import math

import numpy as np
import pytest

from tests.fmu.host import Instantiate
from tests.fmus import native_fmu_only

pytestmark = native_fmu_only

MOVING = ("position", "velocity", "resonator_displacement", "resonator_velocity")


def test_a_ratio_that_changes_its_sign(instantiate: Instantiate) -> None:
    """The normal load turns back, also in flight; held steps, extrapolated, are the reference."""
    rate, stop = -40.0, 0.04
    for phase in (0.0, 2.0, 4.0):
        values = {"normal_amplitude": 1.5, "phase": phase}
        ramped = instantiate().initialize(**values)
        ramped.ramp(frequency_ratio=rate)
        ramped.step(stop)
        ends = []
        for count in (2000, 4000):
            held = instantiate().initialize(**values)
            for k in range(count):
                held.set(frequency_ratio=1.0 + rate * (k + 0.5) * stop / count)
                held.step(stop / count)
            ends.append(np.array(held.get(*MOVING)))
        extrapolated = ends[1] + (ends[1] - ends[0]) / 3.0
        assert ramped.get(*MOVING) == pytest.approx(extrapolated, rel=1e-6), f"phase {phase} rad"


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
