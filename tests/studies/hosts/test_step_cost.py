"""Steps timed from a host in C: every kind of step runs and is reported."""

from __future__ import annotations

from pathlib import Path

import pytest

from studies.hosts.step_cost import (
    LONG_STEP,
    ONE_PERIOD,
    STEPS,
    StepCost,
    measure_steps,
    short_step_ratio,
)


@pytest.mark.slow
def test_every_step_is_timed(native_fmu: Path) -> None:
    costs = measure_steps(native_fmu, 1, lambda name, share: None, 60.0)
    assert [cost.name for cost in costs] == [step.name for step in STEPS]
    assert all(0.0 < cost.fastest <= cost.microseconds <= cost.slowest for cost in costs)


def test_short_steps_are_compared_with_long_ones_per_period() -> None:
    short = StepCost(ONE_PERIOD, 1, microseconds=0.9, fastest=0.6, slowest=2.0)
    long = StepCost(LONG_STEP, 1, microseconds=70.0, fastest=50.0, slowest=90.0)
    assert short_step_ratio([short, long]) == pytest.approx(1.2)
