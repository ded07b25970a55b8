"""Searches on a period map whose steady motion is known."""

from __future__ import annotations

import numpy as np
import pytest

from slider_resonator.steady.newton import Vector
from slider_resonator.steady.shooting import FixedPoint, WarmedUp, blocked_point, steady_point


class _Slider:
    """A slow velocity that (0.1 - load) pushes, saturated as Coulomb friction is, and a swing."""

    period = 2.0

    def __call__(self, state: Vector, load: float) -> tuple[Vector, float]:
        drift = 0.01 * (0.1 - load - np.clip(state[0], -0.5, 0.5))
        return np.array([state[0] + drift, 0.3 * state[1]]), self.period * float(state[0])

    def warm_up(self, velocity: float, load: float) -> WarmedUp:
        return WarmedUp(np.array([velocity + 0.02, 0.1]), np.ones(2), velocity + 0.01)


@pytest.mark.parametrize("velocity", [0.0, 0.3, 40.0])
def test_steady_motion_is_found_from_any_guess(velocity: float) -> None:
    found = steady_point(_Slider(), velocity, 0.03)
    assert isinstance(found, FixedPoint)
    assert found.load == 0.03
    assert found.displacement / _Slider.period == pytest.approx(0.07, abs=1e-9)


def test_blocking_load_is_found() -> None:
    found = blocked_point(_Slider(), _Slider().warm_up(0.0, 0.0), 0.0, 0.2)
    assert isinstance(found, FixedPoint)
    assert found.load == pytest.approx(0.1, abs=1e-10)
    assert found.displacement == pytest.approx(0.0, abs=1e-10)


def test_a_shifted_state_has_the_asked_mean_velocity() -> None:
    warm = WarmedUp(np.array([0.4, 7.0]), np.ones(2), 0.1)
    assert warm.shifted(0.25) == pytest.approx([0.55, 7.0])
    assert warm.state[0] == 0.4, "the warm-up itself stays as it was"
