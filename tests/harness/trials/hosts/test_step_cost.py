"""Steps timed from a host in C: every kind of step runs and is told."""

from __future__ import annotations

from pathlib import Path

import pytest

from slider_resonator.trials.hosts.step_cost import STEPS, measure_steps


@pytest.mark.slow
def test_every_step_is_timed(native_fmu: Path) -> None:
    costs = measure_steps(native_fmu, 1, lambda name, share: None)
    assert [cost.name for cost in costs] == [step.name for step in STEPS]
    assert all(0.0 < cost.fastest <= cost.microseconds <= cost.slowest for cost in costs)
