"""The bristle along the path solves eq. (8): d(sigma_0 z)/dx = sigma_0 (1 - s sigma_0 z / mu)."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fmu_src.python.slider_component.bristle import Bristle

BRISTLE = Bristle(0.4, 1e5, 10.0)


@pytest.mark.parametrize("direction", [1.0, -1.0])
def test_slope_along_the_path(direction: float) -> None:
    for start in (-0.4, -0.1, 0.3):
        step = direction * 1e-12
        slope = (BRISTLE.after(start, step) - start) / step
        assert slope == pytest.approx(1e5 * (1.0 - direction * start / 0.4), rel=1e-4, abs=1.0)


@given(st.floats(-0.4, 0.4), st.floats(-1e-4, 1e-4), st.floats(0.0, 1.0))
def test_paths_add_up(start: float, travel: float, share: float) -> None:
    halfway = BRISTLE.after(start, share * travel)
    end = BRISTLE.after(halfway, (1.0 - share) * travel)
    assert end == pytest.approx(BRISTLE.after(start, travel), abs=1e-15)
    assert abs(end) <= 0.4


def test_fully_bent_after_a_long_path() -> None:
    assert BRISTLE.after(-0.4, 1.0) == 0.4
    assert BRISTLE.after(0.4, -1.0) == -0.4


def test_deep_presliding_keeps_its_digits() -> None:
    tiny = 1e-18
    expected = -0.4 * math.expm1(-1e5 * tiny / 0.4)
    assert BRISTLE.after(0.0, tiny) == pytest.approx(expected, rel=1e-14)
