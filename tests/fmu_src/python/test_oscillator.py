"""Responses of an oscillator against solutions on paper, at and beside their singular points."""

from __future__ import annotations

import cmath
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fmu_src.python.slider_component.oscillator import (
    ForcedMotion,
    Oscillator,
    divided,
    divided_twice,
)

W = 40.0


@pytest.mark.parametrize("t", [1e-9, 1e-3, 0.7, 1.4])
def test_undamped_resonance_grows_with_time(t: float) -> None:
    """y'' + w^2 y = cos(w t) from rest is t sin(w t) / (2 w)."""
    y, u = ForcedMotion(Oscillator(0.0, W * W), ((W, 1.0 + 0j),), 0.0, 0.0).at(t)
    assert y == pytest.approx(t * math.sin(W * t) / (2.0 * W), rel=1e-12)
    expected = (math.sin(W * t) + W * t * math.cos(W * t)) / (2.0 * W)
    assert u == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("beside", [0.0, 1e-12, 1e-8, -1e-8, 1e-5])
def test_critical_damping(beside: float) -> None:
    """From displacement 1 at rest: exp(-w t) (1 + w t)."""
    oscillator = Oscillator(W * (1.0 + beside), W * W)
    y, u = ForcedMotion(oscillator, (), 1.0, 0.0).at(0.05)
    assert y == pytest.approx(math.exp(-2.0) * 3.0, rel=1e-13 + 2.0 * abs(beside))
    assert u == pytest.approx(-math.exp(-2.0) * W * 2.0, rel=1e-13 + 2.0 * abs(beside))


@pytest.mark.parametrize(("decay", "stiffness"), [(0.0, 1e-12), (1e-9, 1e-12), (1e7, 1.0)])
def test_soft_and_stiff_limits_under_a_constant(decay: float, stiffness: float) -> None:
    """Free fall t^2 / 2; or a damper alone, t / (2 decay) after 1 / decay."""
    y, u = ForcedMotion(Oscillator(decay, stiffness), ((0.0, 1.0 + 0j),), 0.0, 0.0).at(1e-2)
    if decay < 1.0:
        assert (y, u) == pytest.approx((5e-5, 1e-2), rel=1e-10)
    else:
        assert u == pytest.approx(1.0 / (2.0 * decay), rel=1e-8)


nodes = st.builds(complex, st.floats(-30.0, 0.0), st.floats(-30.0, 30.0))


@given(nodes, nodes, nodes, st.floats(1e-3, 2.0))
def test_divided_differences_are_integrals(a: complex, b: complex, c: complex, t: float) -> None:
    """exp[a, b] is the integral of exp(b (t - s)) exp(a s), and so on (Hermite-Genocchi)."""
    points, weights = np.polynomial.legendre.leggauss(60)
    s = 0.5 * t * (1.0 + points)
    once = 0.5 * t * np.sum(weights * np.exp(b * (t - s) + a * s))
    assert divided(a, b, t) == pytest.approx(complex(once), abs=1e-12 * t)
    inner = [divided(a, b, float(x)) for x in s]
    twice = 0.5 * t * np.sum(weights * np.exp(c * (t - s)) * inner)
    assert divided_twice(a, b, c, t) == pytest.approx(complex(twice), abs=1e-12 * t * t)


@given(st.floats(0.0, 3.0), st.floats(0.1, 60.0), st.floats(0.0, 0.5), st.floats(0.0, 0.1))
def test_motion_solves_its_equation_within_its_bounds(
    damping: float, f: float, t: float, later: float
) -> None:
    oscillator = Oscillator(damping * W, W * W)
    forcing = ((f, cmath.rect(2.0, 0.4)), (0.0, 0.7 + 0j))
    motion = ForcedMotion(oscillator, forcing, 1e-3, -0.2)
    y, u, acceleration, *bounds = motion.ahead(t)
    assert (y, u) == motion.at(t)
    h = 1e-5
    change = (motion.at(t + h)[1] - motion.at(max(t - h, 0.0))[1]) / (h + min(h, t))
    assert acceleration == pytest.approx(change, abs=bounds[2] * h + 1e-6 * bounds[1])
    after = motion.ahead(t + min(later, motion.horizon))
    assert abs(after[1]) <= bounds[0] * (1.0 + 1e-12)
    assert abs(after[2]) <= bounds[1] * (1.0 + 1e-12)
