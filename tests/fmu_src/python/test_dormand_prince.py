"""The embedded pair: exact solutions, its order, and bounded work."""

from __future__ import annotations

import math

import pytest

from fmu_src.python.slider_resonator.dormand_prince import integrate
from fmu_src.python.slider_resonator.refusal import Refusal


def test_relaxation() -> None:
    velocity, moved = integrate(lambda t, v: 1.0 - v, 0.0, 3.0, 0.1, 1e-11)
    assert velocity == pytest.approx(1.0 - math.exp(-3.0), abs=1e-9)
    assert moved == pytest.approx(3.0 - (1.0 - math.exp(-3.0)), abs=1e-9)


def test_one_step_has_order_five() -> None:
    def error(step: float) -> float:
        velocity, _ = integrate(lambda t, v: math.cos(t) - v, 0.0, step, step, 1.0)
        return abs(velocity - 0.5 * (math.cos(step) + math.sin(step) - math.exp(-step)))

    assert math.log2(error(0.4) / error(0.2)) == pytest.approx(6.0, abs=0.3)


def test_displacement_of_one_step_has_order_five() -> None:
    def error(step: float) -> float:
        _, moved = integrate(lambda t, v: -v, 1.0, step, step, 1.0)
        return abs(moved + math.expm1(-step))

    assert math.log2(error(0.4) / error(0.2)) >= 4.7


def test_error_follows_the_tolerance() -> None:
    errors = []
    for tolerance in (1e-6, 1e-8, 1e-10):
        velocity, _ = integrate(lambda t, v: -v * v, 1.0, 10.0, 1.0, tolerance)
        errors.append(abs(velocity - 1.0 / 11.0))
        assert errors[-1] < 30.0 * tolerance
    assert errors[0] > errors[1] > errors[2]


def test_endless_work_is_refused() -> None:
    with pytest.raises(Refusal, match="averaged motion needs more than"):
        integrate(lambda t, v: -1e9 * v, 1.0, 1e3, 1e-9, 1e-9)
