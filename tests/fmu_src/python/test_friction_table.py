"""The tabulated means of LuGre friction against the quadrature that they are made from."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fmu_src.python.slider_component.averaged_friction import FastMotion
from fmu_src.python.slider_component.averaged_lugre import AVERAGED_LUGRE, friction_means
from fmu_src.python.slider_component.bristle import Bristle
from fmu_src.python.slider_component.friction_table import MAX_ERROR, friction_table

TABLE_1 = FastMotion(0.2366, 3500.0)


def power_of_ten(low: float, high: float) -> st.SearchStrategy[float]:
    return st.floats(low, high).map(lambda exponent: 10.0**exponent)


@given(
    st.sampled_from([1, 2, 3, 8, -1, -2]),
    power_of_ten(-3.0, 14.0),
    st.sampled_from([0.0, 1.0, 10.0, 1e3]),
    st.lists(st.floats(0.0, math.pi), min_size=5, max_size=5),
)
def test_interpolation_error(n: int, stiffness: float, damping: float, turns: list[float]) -> None:
    bristle = Bristle(0.1, stiffness, damping)
    table = friction_table(AVERAGED_LUGRE, bristle, TABLE_1, n)
    scale = max(0.1, *(abs(p[-1]) for panel in table.panels for p in panel))
    layer = (0.1 * TABLE_1.frequency / (stiffness * TABLE_1.velocity)) ** (1 / 3)
    for turning in (*turns, min(layer, 1.0), math.pi - min(layer, 1.0)):
        exact = friction_means(bristle, TABLE_1, n, turning)
        assert tuple(table.at(turning)) == pytest.approx(
            tuple(exact), abs=10.0 * MAX_ERROR * scale
        ), f"means at Theta = {turning!r}"


@pytest.mark.parametrize("stiffness", [1e-3, 1e5, 1e14])
def test_friction_saturates_at_the_fast_velocity(stiffness: float) -> None:
    """Without reversals the bristle stays fully bent: friction is mu, whatever the load does."""
    table = friction_table(AVERAGED_LUGRE, Bristle(0.1, stiffness, 10.0), TABLE_1, 1)
    assert tuple(table.at(0.0)) == pytest.approx((0.1, 0.0, 0.0), abs=1e-7)
    assert tuple(table.at(math.pi)) == pytest.approx((-0.1, 0.0, 0.0), abs=1e-7)


def test_few_panels_even_for_the_hardest_bristles() -> None:
    counts = [
        len(friction_table(AVERAGED_LUGRE, Bristle(0.1, 10.0**k, 10.0), TABLE_1, 1).panels)
        for k in range(-2, 15)
    ]
    assert max(counts) <= 16
