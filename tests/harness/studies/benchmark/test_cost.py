"""Times, errors and ratios of methods whose errors are known."""

from __future__ import annotations

import math
from functools import partial

import numpy as np
import pytest

from slider_resonator.device.device import Device
from slider_resonator.studies.benchmark.cost import (
    REFEREE,
    Cost,
    Method,
    Outcome,
    cheapest_within,
    measure,
    ratio,
)

PERIOD = 2.0 * math.pi / Device().drive_frequency


def outcome(periods: int, step: int, off: float) -> Outcome:
    times = PERIOD * np.arange(0, periods + 1, step, dtype=np.float64)
    return Outcome(
        times, 2.0 * times + off, np.full(len(times), 4.0 + off), 2, len(times) - 1, None
    )


def test_errors_are_taken_at_common_moments() -> None:
    referee = outcome(20, 1, 0.0)
    methods = [
        Method(REFEREE, 20, lambda: referee),
        Method("off by 0.04", 100, partial(outcome, 100, 5, 0.04)),
    ]
    told: list[float] = []
    costs = measure(methods, referee, Device(), 3, lambda name, share: told.append(share))
    same, off = costs
    assert same.velocity_error is None
    assert off.velocity_error == pytest.approx(0.01)
    assert off.position_error == pytest.approx(0.04 / (2.0 * 20 * PERIOD))
    assert off.fastest <= off.microseconds <= off.slowest
    assert (off.steps, off.periods) == (20, 100)
    assert told == sorted(told)
    assert told[-1] == 1.0


def cost(name: str, microseconds: float, error: float) -> Cost:
    return Cost(name, 10, microseconds, microseconds, microseconds, error / 2, error, 0, 1, None)


def test_the_cheapest_that_is_exact_enough() -> None:
    costs = [cost("rough", 1.0, 1e-6), cost("good", 3.0, 1e-9), cost("best", 9.0, 1e-12)]
    assert cheapest_within(costs, 1e-8) == costs[1]
    assert cheapest_within(costs, 1e-13) is None
    compared = ratio(costs[2], costs[1])
    assert compared.time == pytest.approx(3.0)
    assert compared.velocity_error == pytest.approx(1e-3)
