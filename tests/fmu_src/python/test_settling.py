"""Averaged motion that settles: the balance it reaches, and when it may be taken for granted."""

from __future__ import annotations

import math
from collections.abc import Callable

import pytest

from fmu_src.python.slider_component.dormand_prince import Reached
from fmu_src.python.slider_component.settling import NEAR, is_settled, settled

RATE = 50.0


def towards_one(t: float, v: float) -> float:
    return -RATE * (v - 1.0) * (1.0 + 0.3 * (v - 1.0))


def test_the_last_approach_is_in_closed_form() -> None:
    start = Reached(2.0, 1.0 + 0.6 * NEAR, 0.5, 1e-3)
    end = settled(towards_one, 1.0, 102.0, start)
    assert end is not None
    assert end.t == 102.0
    assert end.velocity == pytest.approx(1.0, abs=1e-14)
    assert end.moved == pytest.approx(0.5 + 100.0 + 0.6 * NEAR / RATE, abs=1e-13)


@pytest.mark.parametrize(
    ("acceleration", "start", "until"),
    [
        pytest.param(towards_one, 1.1, 100.0, id="far from balance"),
        pytest.param(towards_one, 1.0 + 0.5 * NEAR, 5.0 / RATE, id="a short rest"),
        pytest.param(lambda t, v: -towards_one(t, v), 1.0 + 0.5 * NEAR, 100.0, id="it repels"),
        # The approach takes far longer than any linear rate says.
        pytest.param(lambda t, v: -((v - 1.0) ** 3), 1.0 + 0.5 * NEAR, 1e6, id="it hardly draws"),
    ],
)
def test_what_does_not_settle_is_followed(
    acceleration: Callable[[float, float], float], start: float, until: float
) -> None:
    assert settled(acceleration, 1.0, until, Reached(0.0, start, 0.0, 1e-3)) is None


def test_a_balance_beside_a_steep_slope() -> None:
    """Mean friction has a slope like that of acos at the fast velocity."""

    def steep(t: float, v: float) -> float:
        return math.copysign(math.sqrt(abs(1.0 - v)), 1.0 - v) * 1e3

    end = settled(steep, 1.0, 10.0, Reached(0.0, 1.0 - 0.9 * NEAR, 0.0, 1e-3))
    assert end is not None
    assert end.velocity == pytest.approx(1.0, abs=1e-12)


@pytest.mark.parametrize(
    ("acceleration", "velocity", "expected"),
    [
        pytest.param(towards_one, 1.0, True, id="in balance"),
        pytest.param(towards_one, 1.0 + 1e-12, False, id="not yet"),
        pytest.param(lambda t, v: -towards_one(t, v), 1.0, False, id="it repels"),
        pytest.param(lambda t, v: 0.0, 1.0, False, id="nothing draws"),
    ],
)
def test_a_velocity_stays_where_forces_draw_it_back(
    acceleration: Callable[[float, float], float], velocity: float, expected: bool
) -> None:
    now = Reached(0.0, velocity, 0.0, 1e-3)
    assert is_settled(acceleration, 1.0, 1e-14, now) is expected
