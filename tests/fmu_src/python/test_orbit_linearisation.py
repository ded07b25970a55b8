"""The slow multiplier of held orbits."""

from __future__ import annotations

import numpy as np
import pytest

from fmu_src.python.slider_component.orbit_linearisation import linearised

SLOW = 0.047
"""Decay of the slow motion in a period."""


@pytest.mark.parametrize("fast", [0.07, 0.1, 0.3, 2.0])
def test_the_slow_multiplier_is_an_eigenvalue_however_near_the_next_one_is(fast: float) -> None:
    """A bristle as slow as that: each iteration leaves a share of the coupling."""
    basis = np.array([[1.0, -0.9, 0.2], [0.4, 1.0, -0.3], [0.1, 0.5, 1.0]])
    states = basis @ np.diag([-SLOW, -fast, -1.5]) @ np.linalg.inv(basis)
    jacobian = np.zeros((4, 4))
    jacobian[:3, :3] = states
    jacobian[:3, 3] = [-0.3, 0.2, 0.1]
    jacobian[3] = [1.0, 0.1, 0.2, -0.2]
    linear = linearised(jacobian.tolist())
    assert linear is not None
    assert 1.0 - linear.multiplier == pytest.approx(SLOW, rel=1e-10)
    largest = max(abs(1.0 - fast), 0.5)
    assert linear.fast_multiplier == pytest.approx(largest, rel=1e-6)
