"""Free motion of an oscillator, by its eigenvalues."""

from __future__ import annotations

import cmath
import math

import numpy as np
import pytest

from fmu_src.python.slider_component.oscillator import Oscillator

W = 40.0


@pytest.mark.parametrize("damping", [0.0, 0.05, 0.8, 1.0, 1.3, 30.0])
def test_free_motion_is_a_matrix_exponential(damping: float) -> None:
    oscillator, t = Oscillator(damping * W, W * W), 0.03
    (a, b), (c, d) = oscillator.free_map(t)
    matrix = np.array([[0.0, 1.0], [-W * W, -2.0 * damping * W]]) * t / 2**30
    power = np.eye(2) + matrix + matrix @ matrix / 2.0
    for _ in range(30):
        power = power @ power
    scale = np.array([[1.0, 1.0 / W], [W, 1.0]])
    assert np.array([[a, b], [c, d]]) / scale == pytest.approx(power / scale, abs=1e-6)
    if oscillator.splits(3.0 * W):
        y = sum((y * cmath.exp(z * t)).real for z, y in oscillator.free(2e-3, -0.7))
        assert y == pytest.approx(2e-3 * a - 0.7 * b, rel=1e-9)


def test_what_loses_digits_does_not_split() -> None:
    assert not Oscillator(W, W * W).splits(W), "critical damping"
    assert not Oscillator(0.0, W * W).splits(W, 3.0 * W), "resonance"
    assert not Oscillator(0.1, 0.1).splits(W), "a soft spring"
    assert Oscillator(0.05 * W, W * W).splits(W, -W, 0.0)
    assert Oscillator(0.0, W * W).transfer(2.0 * W) == pytest.approx(-1.0 / (3.0 * W * W))
    assert math.isclose(Oscillator(0.1, W * W).frequency, W)
