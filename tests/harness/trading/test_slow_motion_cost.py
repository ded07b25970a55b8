"""Second-order averages are far cheaper than resolved motion, all costs of a long run counted."""

from pathlib import Path

import pytest

from slider_resonator.fmu.opening import open_fmu
from tests.harness.trading.slow_motion_cost import (
    DEVICES,
    LEAPING,
    MAX_ERROR,
    RESOLVED,
    cost,
    step_times,
)


def test_a_fast_drive_gains_most(native_fmu: Path) -> None:
    with open_fmu(native_fmu) as fmu:
        found = cost(fmu, DEVICES["table 1, 35 000 rad/s"], 20.0)
    assert 0.0 < found.averaged_by.error < MAX_ERROR
    assert found.ratio > 30.0, "80 on a quiet machine"


@pytest.mark.slow
@pytest.mark.parametrize("stiffness", ["1e4", "1e5", "1e7"])
def test_leaps_gain_on_bristles(native_fmu: Path, stiffness: str) -> None:
    with open_fmu(native_fmu) as fmu:
        found = cost(fmu, DEVICES[f"table 1, LuGre, {stiffness}"], 20.0)
    assert found.averaged_by.error <= MAX_ERROR
    assert found.resolved_by.error <= MAX_ERROR
    assert found.ratio >= 4.0, "7 to 19 on a quiet machine"


def test_steps_of_1000_periods_leap(native_fmu: Path) -> None:
    with open_fmu(native_fmu) as fmu:
        full, leaps = (step_times(fmu, model) for model in (RESOLVED, LEAPING))
    assert full.sum() > 8.0 * leaps.sum(), "17 and more on a quiet machine"
