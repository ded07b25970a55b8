"""Panels of bending bristles against series and known integrals: approximations to their bounds.

Scenes judge motion that is made of them, at tight tolerances and after runs of other devices.
"""

import math

import numpy as np
import pytest

from tests.fmu_src.native_bending import NativeBending, sliding_device

PERIOD = math.tau / 3500.0


def test_decay_is_exponential_to_rounding(native_bending: NativeBending) -> None:
    x = np.concatenate([np.linspace(0.0, 700.0, 70_001), np.logspace(-300, 0, 301)])
    np.testing.assert_allclose(native_bending.decay(x), np.exp(-x), rtol=1e-14)
    assert native_bending.decay(np.array([1e300, np.inf])) == pytest.approx(
        math.exp(-700.0), rel=1e-12
    )


def test_gauss_nodes(native_bending: NativeBending) -> None:
    node, weight, _ = native_bending.gauss()
    expected, expected_weight = np.polynomial.legendre.leggauss(16)
    np.testing.assert_allclose(node, expected, rtol=0.0, atol=1e-15)
    np.testing.assert_allclose(weight, expected_weight, rtol=1e-12)


def test_integrals_are_exact_for_polynomials(native_bending: NativeBending) -> None:
    """Up to the end of twice the order."""
    node, _, integral = native_bending.gauss()
    place = 0.5 * (1.0 + node)
    for power in range(16):
        exact = np.append(place, 1.0) ** (power + 1) / (power + 1)
        np.testing.assert_allclose(integral @ place**power, exact, rtol=1e-12, atol=2e-15)
    for power in range(32):
        assert integral[-1] @ place**power == pytest.approx(1.0 / (power + 1), rel=1e-13)
    assert integral[-1] @ place**100 != pytest.approx(1.0 / 101, rel=1e-9)


def test_random_panels_keep_their_tolerance(native_bending: NativeBending) -> None:
    """At the end, a fifth later and within, against series of tolerance 1e-14."""
    panels = 0
    for seed in range(600):
        tolerance = 0.3 * 10.0 ** -(6 + seed % 7)
        values = sliding_device(seed)
        found = native_bending.panel(values, 3.3 * PERIOD, tolerance, 0.55 + 0.4 * (seed % 11) / 10)
        if found is None:
            continue
        panels += 1
        # The series have an error, too.
        allowed = 2.0 * tolerance + 1e-13
        assert found.velocity <= allowed, (seed, found, tolerance)
        assert found.later <= allowed, (seed, found, tolerance)
        assert found.travel <= allowed * PERIOD, (seed, found, tolerance)
        # Only means over periods that end within a panel need this: to the tolerance of the user.
        assert found.within <= 100.0 * allowed * PERIOD, (seed, found, tolerance)
    assert panels > 250
