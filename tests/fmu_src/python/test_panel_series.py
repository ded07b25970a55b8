"""Polynomials through values at the nodes of a panel."""

from __future__ import annotations

import math

import numpy as np
import pytest

from fmu_src.python.slider_component.orbit_nodes import HOLDING
from fmu_src.python.slider_component.panel_series import NODE, ORBIT_NODES, PanelSeries

PLACES = np.linspace(-1.0, 1.0, 401)


def series_of(count: int, value: np.ufunc = np.exp) -> PanelSeries:
    series = PanelSeries()
    for x in NODE[:count]:
        series.add(float(value(x)))
    return series


def largest_error(series: PanelSeries, value: np.ufunc = np.exp) -> float:
    return max(abs(series.at(x) - float(value(x))) for x in PLACES)


@pytest.mark.parametrize("count", range(1, ORBIT_NODES + 1))
def test_a_series_has_its_values(count: int) -> None:
    series = series_of(count)
    for x in NODE[:count]:
        assert series.at(x) == pytest.approx(math.exp(x), abs=1e-14)


@pytest.mark.parametrize("value", [np.exp, np.arctan])
@pytest.mark.parametrize("count", range(6, 12))
def test_a_series_with_a_large_error_misses_one_of_the_next_two_nodes(
    value: np.ufunc, count: int
) -> None:
    """At one alone it may be far less: a function has its symmetries."""
    series = series_of(count, value)
    error = largest_error(series, value)
    missed = max(abs(series.add(float(value(x)))) for x in NODE[count : count + HOLDING])
    assert missed >= 0.1 * error


@pytest.mark.parametrize("side", [1, -1])
@pytest.mark.parametrize("count", [1, 2, 7, ORBIT_NODES])
def test_chebyshev_coefficients_are_those_of_the_series(count: int, side: int) -> None:
    series = series_of(count)
    values = np.polynomial.chebyshev.chebval(side * PLACES, series.chebyshev(side))
    assert values == pytest.approx([series.at(x) for x in PLACES], abs=1e-13)
