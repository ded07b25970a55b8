from __future__ import annotations

import numpy as np
import pytest

from slider_resonator.steady.bracketing import bracketed_state
from slider_resonator.steady.newton import Vector
from slider_resonator.steady.shooting import FixedPoint, fixed_point


def saturated_map(state: Vector) -> tuple[Vector, float]:
    """A drift that saturates outside |v| < 1 with vertical tangents, beside a fast oscillator."""
    v, y, u = state
    inside = float(np.clip(v + 0.1 * y, -1.0, 1.0))
    drift = 0.97 - 2.0 / np.pi * np.arccos(inside)
    fast = np.array([[0.4, 0.5], [-0.5, 0.4]]) @ np.array([y - 0.2, u + 0.1])
    return np.array([v - 1e-3 * drift, 0.2 + fast[0], -0.1 + fast[1]]), v


def test_bracketing_finds_a_root_out_of_reach_of_newton() -> None:
    guess, scale = np.array([40.0, 1.0, 1.0]), np.ones(3)
    state = bracketed_state(saturated_map, guess, scale)
    assert state is not None
    assert np.abs(saturated_map(state)[0] - state).max() < 1e-12
    found = fixed_point(saturated_map, state, scale)
    assert isinstance(found, FixedPoint), "Newton must accept what lies between the bounds"


def test_single_slow_state_needs_no_elimination() -> None:
    state = bracketed_state(lambda s: (s - 1e-3 * np.tanh(s - 0.4), 0.0), np.zeros(1), np.ones(1))
    assert state is not None
    assert abs(state[0] - 0.4) < 1e-12


def test_one_sided_drift_has_no_bracket() -> None:
    assert bracketed_state(lambda s: (s - 1e-3, 0.0), np.zeros(1), np.ones(1)) is None


def test_bracketing_renews_its_jacobian_for_a_bristle_state() -> None:
    """As a soft bristle does: one Jacobian does not serve for all velocities."""

    def period_map(state: Vector) -> tuple[Vector, float]:
        v, bend = state
        held = np.exp(-abs(v))
        return np.array([v + 1e-3 * (0.3 - np.tanh(v)), bend * held + (1.0 - held) * v]), v

    state = bracketed_state(period_map, np.array([-0.05, 1.0]), np.array([3.0, 1.0]))
    assert state is not None
    assert state == pytest.approx(np.arctanh([0.3, 0.3]), abs=1e-9)


def test_growing_fast_state_has_no_bracket() -> None:
    growing = bracketed_state(
        lambda s: (np.array([-s[0], s[1] + 1.0]), 0.0), np.zeros(2), np.ones(2)
    )
    assert growing is None
