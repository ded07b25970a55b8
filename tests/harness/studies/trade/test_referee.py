"""The truth of a task, and how well it is known."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from slider_resonator.references.resolved import taylor
from slider_resonator.studies.trade.referee import referee
from slider_resonator.studies.trade.task import TRUTH_STEPS
from tests.harness.studies.trade.scenes import RAMP, STICKING, TABLE_1, task

HELD_BY_FRICTION = """
[device]
base_amplitude = 0.0
normal_amplitude = 0.0
[inputs]
load = { ramp = [[0.0, 0.0], [0.005, 0.1]] }
[run]
drive_periods = 4
steps_per_period = 4
"""


def test_table_1_by_a_run_and_by_shooting(tmp_path: Path) -> None:
    truth = referee(task(tmp_path, TABLE_1, most_periods=2))
    assert truth.steady_velocity == pytest.approx(0.12666700, rel=1e-7)
    assert truth.blocking_force == pytest.approx(0.0851861, rel=1e-6)
    assert truth.uncertainty == 0.0, "inputs that do not vary are held without an error"
    assert not truth.sticks, "reversals follow each other without a stick"


def test_a_drive_weaker_than_friction_sticks(tmp_path: Path) -> None:
    assert referee(task(tmp_path, STICKING, most_periods=3)).sticks


def test_the_uncertainty_is_what_finer_steps_of_a_ramp_would_change(tmp_path: Path) -> None:
    ramp = task(tmp_path, RAMP)
    usual, fine = (
        taylor.simulate(ramp.device, ramp.truth(16, steps), ramp.readings(16)).position
        for steps in (TRUTH_STEPS, 8 * TRUTH_STEPS)
    )
    off = np.abs(usual - fine).max() / np.abs(fine).max()
    told = referee(ramp).uncertainty
    assert off / 3.0 < told < 5.0 * off, f"{told:.1e} is told, {off:.1e} would change"


def test_a_slider_that_friction_holds_is_known_exactly(tmp_path: Path) -> None:
    truth = referee(task(tmp_path, HELD_BY_FRICTION))
    assert truth.uncertainty == 0.0, "0 of nothing, not 0 / 0"
    assert not truth.windows.position.any()
