"""The angle of balance equals that of plain bisection."""

from __future__ import annotations

from collections.abc import Callable
from math import cos, pi, sin

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fmu_src.python.slider_component.balance import (
    BISECTIONS,
    Balance,
    Point,
    balanced_turning,
)

Excess = Callable[[float], float]


def by_bisection(excess: Excess) -> float:
    low, high = 0.0, pi
    for _ in range(BISECTIONS):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if excess(middle) > 0.0 else (low, middle)
    return 0.5 * (low + high)


def found(excess: Excess, *, noise: float = 1e-15, rises: bool = False) -> tuple[float, int]:
    """The angle, and how often the excess was asked for beyond the first three."""
    calls = 0

    def counted(turning: float) -> float:
        nonlocal calls
        calls += 1
        return excess(turning)

    points = (Point(turning, excess(turning)) for turning in (0.0, 0.5 * pi, pi))
    low, halfway, high = points
    return balanced_turning(Balance(counted, counted, noise, rises), low, halfway, high), calls


@given(st.floats(0.01, 1.0), st.floats(-1.0, 1.0), st.floats(-1.2, 1.2))
def test_falling_friction(preload: float, swing: float, load: float) -> None:
    def excess(turning: float) -> float:
        falling = preload * (1.0 - 2.0 / pi * turning)
        return falling + min(0.3, preload / pi) * swing * sin(2.0 * turning) + load

    turning, _ = found(excess)
    assert turning == pytest.approx(by_bisection(excess), abs=1e-12)


def test_few_evaluations_do_where_bisection_takes_52() -> None:
    _, calls = found(lambda turning: 1.0 - 2.0 / pi * turning - 0.2 * sin(turning) + 0.05)
    assert calls <= 15


def test_one_of_several_balances_is_that_of_bisection() -> None:
    def excess(turning: float) -> float:
        return cos(5.0 * turning) + 0.1

    turning, _ = found(excess, rises=True)
    assert turning == pytest.approx(by_bisection(excess), abs=1e-12)


@pytest.mark.parametrize(("level", "end"), [(1.0, pi), (-1.0, 0.0)])
def test_without_a_balance_the_end_counts(level: float, end: float) -> None:
    turning, _ = found(lambda _: level)
    assert turning == end


def test_flat_friction_is_bisected_as_rounding_has_it() -> None:
    """Within its noise the sign of the excess is that of each evaluation."""

    def excess(turning: float) -> float:
        return -((turning - 1.0) ** 5)

    turning, _ = found(excess)
    assert turning == pytest.approx(by_bisection(excess), abs=1e-9)
