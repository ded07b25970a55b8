"""Averaged motion that settles: the balance it reaches, and when it may be taken for granted."""

from __future__ import annotations

import math

import pytest

from fmu_src.python.slider_component.dormand_prince import Reached
from fmu_src.python.slider_component.settling import NEAR, settled

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


def test_far_from_balance_is_followed() -> None:
    assert settled(towards_one, 1.0, 100.0, Reached(0.0, 1.1, 0.0, 1e-3)) is None


def test_a_short_rest_is_followed() -> None:
    start = Reached(0.0, 1.0 + 0.5 * NEAR, 0.0, 1e-3)
    assert settled(towards_one, 1.0, 5.0 / RATE, start) is None


def test_a_balance_that_repels_is_followed() -> None:
    start = Reached(0.0, 1.0 + 0.5 * NEAR, 0.0, 1e-3)
    assert settled(lambda t, v: -towards_one(t, v), 1.0, 100.0, start) is None


def test_a_balance_that_hardly_draws_is_followed() -> None:
    """Near v = 1 the approach to (v - 1)^3 takes far longer than any linear rate says."""
    start = Reached(0.0, 1.0 + 0.5 * NEAR, 0.0, 1e-3)
    assert settled(lambda t, v: -((v - 1.0) ** 3), 1.0, 1e6, start) is None


def test_a_balance_beside_a_steep_slope() -> None:
    """Mean friction has a slope like that of acos at the fast velocity."""

    def steep(t: float, v: float) -> float:
        return math.copysign(math.sqrt(abs(1.0 - v)), 1.0 - v) * 1e3

    end = settled(steep, 1.0, 10.0, Reached(0.0, 1.0 - 0.9 * NEAR, 0.0, 1e-3))
    assert end is not None
    assert end.velocity == pytest.approx(1.0, abs=1e-12)
