from __future__ import annotations

import numpy as np
import pytest
from numpy.polynomial import Polynomial

from slider_resonator.references.resolved.polynomial_roots import first_fall

NOISE = 1e-15


def fall(polynomial: Polynomial, stop: float = 1.0) -> float | None:
    terms = polynomial.coef.astype(np.float64) * stop ** np.arange(len(polynomial.coef))
    share = first_fall(terms, NOISE)
    return None if share is None else share * stop


def test_first_of_several_roots_is_found() -> None:
    polynomial = -Polynomial.fromroots([0.3, 0.5, 0.7])
    assert fall(polynomial) == pytest.approx(0.3, rel=1e-14), "it falls at 0.3 and again at 0.7"
    rising_first = Polynomial.fromroots([-0.1, 0.3, 0.7])
    assert rising_first(0.0) > 0.0
    assert fall(rising_first) == pytest.approx(0.3, rel=1e-14)


@pytest.mark.parametrize("gap", [1e-2, 1e-4, 1e-6])
def test_twin_roots_are_not_stepped_over(gap: float) -> None:
    twins = Polynomial.fromroots([0.37, 0.37 + gap])
    assert fall(twins) == pytest.approx(0.37, abs=1e-15 / gap)


def test_near_miss_is_no_root() -> None:
    near_miss = Polynomial.fromroots([0.37, 0.37]) + 1e-9
    assert fall(near_miss) is None
    assert fall(Polynomial([0.0, 0.0, 0.0])) is None, "identically zero does not fall"


def test_roots_beyond_the_interval_are_not_reported() -> None:
    assert fall(Polynomial([1.0, -1.0]), stop=0.999) is None
    assert fall(Polynomial([2.0, -1.0]), stop=4.0) == pytest.approx(2.0), "the interval is scaled"


@pytest.mark.parametrize("order", [1, 2])
def test_root_at_the_start_counts_only_if_the_polynomial_falls(order: int) -> None:
    start = Polynomial.fromroots([0.0] * order)
    assert fall(start * Polynomial([1.0, -2.0])) == pytest.approx(0.5), "rises, falls at 0.5"
    assert fall(-start) == 0.0, "falls at once"
    rounded = start * Polynomial([1.0, -2.0]) - 1e-17
    assert fall(rounded) == pytest.approx(0.5), "a start below zero by rounding is a root there"


def test_random_polynomials_agree_with_a_fine_grid() -> None:
    random = np.random.default_rng(1)
    grid = np.linspace(0.0, 1.0, 20_001)
    for _ in range(200):
        coefficients = random.normal(size=23) * 2.0 ** np.arange(23)
        coefficients[0] = abs(coefficients[0])
        below = np.flatnonzero(Polynomial(coefficients)(grid) < 0.0)
        found = first_fall(coefficients, NOISE * 2.0**23)
        if below.size:
            assert found is not None
            assert grid[below[0] - 1] - 1e-9 <= found <= grid[below[0]], "the first on the grid"
        elif found is not None:
            assert Polynomial(coefficients)(found) == pytest.approx(0.0, abs=1e-6)
