"""Second-order averages are far cheaper than resolved motion, all costs of a long run counted."""

from __future__ import annotations

from pathlib import Path

import pytest

from slider_resonator.fmu.opening import open_fmu
from tests.harness.studies.trade.slow_motion_cost import (
    AVERAGED,
    DEVICES,
    FIRST_ORDER,
    MAX_ERROR,
    cost,
    step_times,
)


def test_a_fast_drive_gains_most(native_fmu: Path) -> None:
    with open_fmu(native_fmu) as fmu:
        found = cost(fmu, DEVICES["table 1, 35 000 rad/s"], 20.0)
    assert 0.0 < found.averaged_by.error < MAX_ERROR
    assert found.ratio > 30.0, "80 on a quiet machine"
    assert found.again < found.averaged


@pytest.mark.parametrize("stiffness", ["1e4", "1e5", "1e7"])
def test_lugre_friction_gains_ten_times(native_fmu: Path, stiffness: str) -> None:
    with open_fmu(native_fmu) as fmu:
        found = cost(fmu, DEVICES[f"table 1, LuGre, {stiffness}"], 20.0)
    assert found.averaged_by.error <= MAX_ERROR
    assert found.resolved_by.error <= MAX_ERROR
    assert found.ratio >= 10.0


def test_steps_of_1000_periods_cost_little_more_than_with_first_order(native_fmu: Path) -> None:
    with open_fmu(native_fmu) as fmu:
        first, second = (step_times(fmu, order) for order in (FIRST_ORDER, AVERAGED))
    assert (second[1:] < 4.0 * first[1:]).all(), "3 on a quiet machine"
    assert second[0] < 3e-3, "preparation: 0.2 ms"
    assert second[-1] < 0.7 * second[15], "motion that has settled goes on as it is"
