from __future__ import annotations

import numpy as np
import pytest
from numpy.polynomial import Polynomial

from slider_resonator.references.averaged.device_average import stable_velocity
from slider_resonator.references.averaged.slow_trajectory import slow_trajectory


def test_monotonic_friction_has_one_velocity() -> None:
    assert stable_velocity(lambda v: v - 0.2, 1.0, 0.1) == pytest.approx(0.1, abs=1e-12)


def test_forward_one_of_two_stable_velocities_is_returned() -> None:
    """v^3 - 0.25 v has its stable roots at +-0.5; the shift says where the slider sets off."""
    for shift, side in ((-1e-6, 1.0), (1e-6, -1.0)):
        cubic = Polynomial([shift, -0.25, 0.0, 1.0])
        found = stable_velocity(cubic, 1.0, 0.0)
        assert found == pytest.approx(side * 0.5, abs=1e-4)


def test_load_above_all_friction_is_refused() -> None:
    with pytest.raises(ValueError, match="load = 2"):
        stable_velocity(lambda v: v, 1.0, 2.0)


def test_trajectory_decays_toward_a_terminal_velocity() -> None:
    times = np.linspace(0.0, 3.0, 7)
    position, velocity = slow_trajectory(lambda time, v: 1.0 - v, times, velocity=0.5)
    assert velocity == pytest.approx(1.0 - 0.5 * np.exp(-times), abs=1e-6)
    assert position == pytest.approx(times - 0.5 * (1.0 - np.exp(-times)), abs=1e-6)
