"""The embedded pair: exact solutions, its order, and bounded work."""

from __future__ import annotations

import math
from collections.abc import Callable

import pytest

from fmu_src.python.slider_component.dormand_prince import Reached, integrate

MOST = 10_000


def passed(
    acceleration: Callable[[float, float], float],
    velocity: float,
    duration: float,
    step: float,
    tolerance: float,
) -> tuple[float, float]:
    """Velocity and displacement at the end."""
    end = integrate(acceleration, Reached(0.0, velocity, 0.0, step), duration, tolerance, MOST)
    assert end.t == duration
    return end.velocity, end.moved


def test_one_step_has_order_five() -> None:
    def errors(step: float) -> tuple[float, float]:
        velocity, _ = passed(lambda t, v: math.cos(t) - v, 0.0, step, step, 1.0)
        _, moved = passed(lambda t, v: -v, 1.0, step, step, 1.0)
        exact = 0.5 * (math.cos(step) + math.sin(step) - math.exp(-step))
        return abs(velocity - exact), abs(moved + math.expm1(-step))

    coarse, fine = errors(0.4), errors(0.2)
    assert math.log2(coarse[0] / fine[0]) == pytest.approx(6.0, abs=0.3), "velocity"
    assert math.log2(coarse[1] / fine[1]) >= 4.7, "displacement"


def test_error_follows_the_tolerance() -> None:
    errors = []
    for tolerance in (1e-6, 1e-8, 1e-10):
        velocity, _ = passed(lambda t, v: -v * v, 1.0, 10.0, 1.0, tolerance)
        errors.append(abs(velocity - 1.0 / 11.0))
        assert errors[-1] < 30.0 * tolerance
    assert errors[0] > errors[1] > errors[2]


def test_goes_on_from_where_it_was() -> None:
    def acceleration(t: float, v: float) -> float:
        return math.cos(t) - v

    now = Reached(0.0, 0.0, 0.0, 0.01)
    while now.t < 5.0:
        now = integrate(acceleration, now, 5.0, 1e-10, 3)
    exact = 0.5 * (math.cos(5.0) + math.sin(5.0) - math.exp(-5.0))
    assert now.velocity == pytest.approx(exact, abs=1e-8)
    assert now.moved == pytest.approx(math.sin(5.0) - exact, abs=1e-8), "the integral of v' + v"


def test_work_is_bounded() -> None:
    calls = []

    def stiff(t: float, v: float) -> float:
        calls.append(t)
        return -1e9 * v

    now = integrate(stiff, Reached(0.0, 1.0, 0.0, 1e-9), 1e3, 1e-9, 100)
    assert 0.0 < now.t < 1e3
    assert len(calls) <= 1 + 6 * 100, "six evaluations for each step, and the first"
