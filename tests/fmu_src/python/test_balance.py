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


@pytest.mark.parametrize(("level", "end"), [(1.0, pi), (-1.0, 0.0)])
def test_without_a_balance_the_end_counts(level: float, end: float) -> None:
    turning, _ = found(lambda _: level)
    assert turning == end


@pytest.mark.parametrize(
    ("excess", "rises", "tolerance"),
    [
        pytest.param(lambda angle: cos(5.0 * angle) + 0.1, True, 1e-12, id="one of several"),
        # Within its noise the sign of the excess is that of each evaluation.
        pytest.param(lambda angle: -((angle - 1.0) ** 5), False, 1e-9, id="flat friction"),
    ],
)
def test_the_balance_is_that_of_bisection(excess: Excess, rises: bool, tolerance: float) -> None:
    turning, _ = found(excess, rises=rises)
    assert turning == pytest.approx(by_bisection(excess), abs=tolerance)


@given(st.floats(0.2, 2.0), st.floats(0.02, 1.0), st.floats(-1.0, 1.0))
def test_a_flat_balance_ends_where_friction_begins(begin: float, width: float, tilt: float) -> None:
    """Rounding may tilt what is flat: the answer is the smallest angle, the highest velocity."""

    def excess(turning: float) -> float:
        beyond = min(turning - begin, max(turning - begin - width, 0.0))
        return -0.3 * beyond + 0.9e-15 * tilt

    turning, _ = found(excess)
    assert turning == pytest.approx(begin, abs=1e-11)
