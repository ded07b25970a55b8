from __future__ import annotations

import os
import signal
from pathlib import Path

import pytest

from slider_resonator.errors import FmuError
from slider_resonator.trials.extremes.cell import Cell, Hold, Model
from slider_resonator.trials.extremes.run import run_matrix
from slider_resonator.trials.extremes.verdict import FAILED, PASSED
from slider_resonator.trials.extremes.worker import Broken, working

QUICK = Cell("steps", "few", Model(2, 0), {}, (Hold(1e-4, 20),))
ENDLESS = Cell("steps", "far too many", Model(2, 0), {}, (Hold(1.0, 100_000),))


def test_a_hang_costs_one_cell(native_fmu: Path) -> None:
    told: list[float] = []
    matrix = run_matrix(native_fmu, [ENDLESS, QUICK], lambda _, share: told.append(share), 2.0)
    assert [one.verdict for one in matrix.verdicts] == [FAILED, PASSED]
    assert "hung" in matrix.verdicts[0].reason
    assert told == [0.0, 0.5], "progress is shown by cells"
    assert "2 cells: 1 passed, 0 refused by name, 1 failed, none skipped" in matrix.summary


def test_a_crash_costs_one_cell(native_fmu: Path) -> None:
    with working(native_fmu, 20.0) as worker:
        process = worker._process.pid
        assert process is not None
        os.kill(process, signal.SIGKILL)
        with pytest.raises(Broken, match="crashed"):
            worker.observe(QUICK)
        assert worker.observe(QUICK).refusal is None


def test_an_fmu_that_is_none_is_no_verdict(tmp_path: Path) -> None:
    with pytest.raises(FmuError, match="no such file"), working(tmp_path / "none.fmu", 20.0):
        pass
