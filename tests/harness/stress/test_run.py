from __future__ import annotations

from pathlib import Path

import pytest

from slider_resonator.errors import FmuError
from slider_resonator.stress.case import Hold, MatrixCell, Model
from slider_resonator.stress.run import Matrix, run_matrix
from slider_resonator.stress.verdict import FAILED, PASSED
from tests.harness.faulty_fmus import compiled

QUICK = MatrixCell("steps", "few", Model(2, 0), {}, (Hold(1e-4, 20),))
ENDLESS = MatrixCell("steps", "far too many", Model(2, 0), {}, (Hold(1.0, 100_000),))


def test_a_hang_costs_one_cell(native_fmu: Path) -> None:
    shares: list[float] = []
    matrix = run_matrix(native_fmu, [ENDLESS, QUICK], lambda _, share: shares.append(share), 2.0)
    assert [one.verdict for one in matrix.verdicts] == [FAILED, PASSED]
    assert "no answer within the time limit of 2 s" in matrix.verdicts[0].reason
    assert shares == [0.0, 0.5], "progress is shown by cells"
    assert "2 cells: 1 passed, 0 refused by name, 1 failed, none skipped" in matrix.summary


def test_an_fmu_that_crashes_in_every_cell_fails_each(native_fmu: Path, tmp_path: Path) -> None:
    crash = compiled(native_fmu, tmp_path / "crash.fmu", "IN_STEP=CRASH")
    cells = [MatrixCell("steps", str(n), Model(2, 0), {}, (Hold(1e-4, 20),)) for n in range(4)]
    matrix = run_matrix(crash, cells, lambda *_: None, 20.0)
    assert [one.verdict for one in matrix.verdicts] == [FAILED] * 4
    assert all("crashed in fmi2DoStep" in one.reason for one in matrix.verdicts)


def test_an_fmu_that_cannot_be_opened_is_no_verdict(tmp_path: Path) -> None:
    with pytest.raises(FmuError, match="no such file"):
        run_matrix(tmp_path / "none.fmu", [QUICK], lambda *_: None)


def test_an_interrupted_run_gives_what_has_run(native_fmu: Path) -> None:
    def interrupt(label: str, share: float) -> None:
        if share > 0.0:
            raise KeyboardInterrupt

    kept: list[Matrix] = []
    with pytest.raises(KeyboardInterrupt):
        run_matrix(native_fmu, [QUICK, QUICK, QUICK], interrupt, 60.0, kept.append)
    (matrix,) = kept
    assert [one.verdict for one in matrix.verdicts] == [PASSED]
    assert matrix.not_run == 2
    assert not matrix.passed
    assert "0 failed, 2 not run" in matrix.summary
