"""Panels of bending bristles against series and known integrals: approximations to their bounds."""

import math

import numpy as np
import pytest
from numpy.typing import NDArray

from tests.fmu_src.native_bending import NativeBending, sliding_device

TABLE_1 = {"friction_law": 1.0, "phase": 0.4}
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


def test_integrals_between_nodes_are_exact_for_polynomials(native_bending: NativeBending) -> None:
    node, _, integral = native_bending.gauss()
    place = 0.5 * (1.0 + node)
    for power in range(16):
        exact = np.append(place, 1.0) ** (power + 1) / (power + 1)
        np.testing.assert_allclose(integral @ place**power, exact, rtol=1e-12, atol=2e-15)


def test_integrals_up_to_the_end_are_exact_for_twice_the_order(
    native_bending: NativeBending,
) -> None:
    node, _, integral = native_bending.gauss()
    place = 0.5 * (1.0 + node)
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


def _largest(states: NDArray[np.float64], reference: NDArray[np.float64]) -> float:
    """Return the largest error of position and velocity over their peaks."""
    peak = np.abs(reference[:2]).max(axis=1) + 1e-300
    return float((np.abs(states[:2] - reference[:2]).max(axis=1) / peak).max())


@pytest.mark.parametrize("stiffness", [1e5, 1e8, 1e14])
@pytest.mark.parametrize("damping", [0.0, 10.0])
def test_table_1_keeps_the_tolerance(
    native_bending: NativeBending, stiffness: float, damping: float
) -> None:
    values = TABLE_1 | {"bristle_stiffness": stiffness, "bristle_damping": damping}
    fine = native_bending.run(values, PERIOD, 200, tolerance=1e-14, panels=False)
    assert fine is not None
    errors = []
    for tolerance in (1e-6, 1e-8, 1e-10):
        panels = native_bending.run(values, PERIOD, 200, tolerance=tolerance)
        assert panels is not None
        errors.append(_largest(panels, fine))
        assert errors[-1] <= 30.0 * tolerance, errors
    assert errors[0] > 100.0 * errors[-1], "a tolerance that changes nothing bounds nothing"


def test_tables_leave_no_trace(native_bending: NativeBending) -> None:
    """Kernels that other devices have left, or none: the same numbers to the last bit."""
    for seed in (1, 2, 3):
        native_bending.run(sliding_device(seed), 1e-3, 20, tolerance=1e-7, warm=True)
        for stiffness in (1e5, 1e8):
            values = TABLE_1 | {"bristle_stiffness": stiffness, "frequency_ratio": 1.0 + seed}
            warm = native_bending.run(values, 0.37 * PERIOD, 60, tolerance=1e-8, warm=True)
            cold = native_bending.run(values, 0.37 * PERIOD, 60, tolerance=1e-8)
            assert warm is not None
            assert cold is not None
            np.testing.assert_array_equal(warm, cold)
