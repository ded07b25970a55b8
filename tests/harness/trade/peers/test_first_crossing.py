from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.polynomial import Polynomial

from slider_resonator.trade.peers.first_crossing import first_crossing

GRID = np.linspace(0.0, 1.0, 9)


def crossing(value: Polynomial, floor: float = 1e-15) -> float | None:
    slope = value.deriv()
    function: Callable[[float], tuple[float, float]] = lambda time: (value(time), slope(time))  # noqa: E731
    return first_crossing(GRID, value(GRID), slope(GRID), function, floor)


def test_single_crossing_is_located() -> None:
    assert crossing(Polynomial([0.3, -1.0])) == pytest.approx(0.3, rel=1e-14)
    assert crossing(Polynomial([1.0, -0.5])) is None, "it stays positive"


def test_twin_roots_between_grid_points_are_found() -> None:
    twins = Polynomial.fromroots([0.43, 0.4301])
    assert (twins(GRID) > 0.0).all(), "the grid alone does not see them"
    assert crossing(twins) == pytest.approx(0.43, abs=1e-11)
    assert crossing(twins + 1e-8) is None, "a minimum above zero is no event"


def test_start_on_a_root_is_no_event() -> None:
    leaving = Polynomial([0.0, 0.04, -1.0])
    assert crossing(leaving) == pytest.approx(0.04), "back at zero within the first interval"
    assert crossing(Polynomial([0.0, 1.0])) is None, "it leaves for good"
    assert crossing(Polynomial([-1e-18, 1.0])) is None, "below zero by rounding only"


def test_start_on_a_root_is_an_event_if_the_function_falls() -> None:
    assert crossing(Polynomial([0.0, -1.0])) == 0.0


@pytest.mark.parametrize("end", [0, 1])
def test_slope_whose_sign_at_an_end_is_one_of_rounding_gives_no_event(end: int) -> None:
    lowest = GRID[3 + end]
    dip = Polynomial([0.5 + lowest**2, -2.0 * lowest, 1.0])
    slope, rounding = dip.deriv(), -1e-18 if end == 0 else 1e-18
    slopes = slope(GRID)
    slopes[3 + end] = rounding
    function: Callable[[float], tuple[float, float]] = lambda time: (  # noqa: E731
        dip(time),
        slope(time) - rounding,
    )
    assert first_crossing(GRID, dip(GRID), slopes, function, 1e-15) is None
