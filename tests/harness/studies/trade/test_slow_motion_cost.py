"""Second-order averages are far cheaper than resolved motion, all costs of a long run counted."""

from __future__ import annotations

from pathlib import Path

from slider_resonator.fmu.opening import open_fmu
from tests.harness.studies.trade.slow_motion_cost import DEVICES, MAX_ERROR, cost


def test_a_fast_drive_gains_most(native_fmu: Path) -> None:
    with open_fmu(native_fmu) as fmu:
        found = cost(fmu, DEVICES["table 1, 35 000 rad/s"], 20.0)
    assert 0.0 < found.averaged_error < MAX_ERROR
    assert found.ratio > 30.0, "80 on a quiet machine"
    assert found.again < found.averaged
