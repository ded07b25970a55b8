from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from slider_resonator.device.model import Model
from slider_resonator.errors import FmuError
from slider_resonator.output.progress import no_progress
from slider_resonator.stressing.case import RANDOM, Case, Hold
from slider_resonator.stressing.run import StressResult, applicable, run_cases
from slider_resonator.stressing.verdict import FAILED, PASSED, REFUSED, Verdict
from tests.harness.faulty_fmus import compiled, without_later_variables

QUICK = Case("steps", "few", Model(2, 0), {}, (Hold(1e-4, 20),))
ENDLESS = Case("steps", "far too many", Model(2, 0), {}, (Hold(1.0, 100_000),))
LEAPING = replace(QUICK, model=Model(0, 0, 2))


@pytest.mark.isolated
@pytest.mark.slow
def test_a_hang_costs_one_case(native_fmu: Path) -> None:
    shares: list[float] = []
    result = run_cases(native_fmu, [ENDLESS, QUICK], lambda _, share: shares.append(share), 2.0)
    assert [one.verdict for one in result.verdicts] == [FAILED, PASSED]
    assert "no answer within the time limit of 2 s" in result.verdicts[0].reason
    assert shares == [0.0, 0.5], "progress is shown by cases"
    assert "2 cases: 1 passed, 0 refused by name, 1 failed, none skipped" in result.summary
    assert f"--case '{ENDLESS.name}'" in "\n".join(result.sentences()), (
        "the command that runs it again"
    )


@pytest.mark.isolated
def test_an_fmu_that_crashes_in_every_case_fails_each(native_fmu: Path, tmp_path: Path) -> None:
    crash = compiled(native_fmu, tmp_path / "crash.fmu", "IN_STEP=CRASH")
    cases = [replace(QUICK, value=str(n)) for n in range(4)]
    result = run_cases(crash, cases, no_progress, 20.0)
    assert [one.verdict for one in result.verdicts] == [FAILED] * 4
    assert all("crashed in fmi2DoStep" in one.reason for one in result.verdicts)


def test_several_processes_give_the_same_verdicts(native_fmu: Path) -> None:
    cases = [replace(QUICK, holds=(Hold(1e-4, n),), value=str(n)) for n in range(1, 9)]
    alone = run_cases(native_fmu, cases, no_progress)
    shared = run_cases(native_fmu, cases, no_progress, jobs=2)
    assert [one.name for one in shared.verdicts] == [case.name for case in cases]
    assert [one.nearest for one in shared.verdicts] == [one.nearest for one in alone.verdicts]


def test_an_fmu_that_cannot_be_opened_is_no_verdict(tmp_path: Path) -> None:
    with pytest.raises(FmuError, match="no such file"):
        run_cases(tmp_path / "none.fmu", [QUICK], no_progress)


def test_cases_that_an_fmu_lacks_variables_for_are_skipped(
    native_fmu: Path, tmp_path: Path
) -> None:
    older = without_later_variables(native_fmu, tmp_path / "older.fmu")
    result = run_cases(older, [QUICK, LEAPING], no_progress)
    assert result.passed
    assert [one.name for one in result.verdicts] == [QUICK.name]
    assert "1 skipped" in result.summary
    with pytest.raises(FmuError, match=r"no case applies .* lacks .*averaging_order"):
        applicable(older, [LEAPING])


def test_an_interrupted_run_gives_what_has_run(native_fmu: Path) -> None:
    def interrupt(label: str, share: float) -> None:
        if share > 0.0:
            raise KeyboardInterrupt

    kept: list[StressResult] = []
    with pytest.raises(KeyboardInterrupt):
        run_cases(native_fmu, [QUICK, QUICK, QUICK], interrupt, 60.0, keep=kept.append)
    (result,) = kept
    assert [one.verdict for one in result.verdicts] == [PASSED]
    assert result.not_run == 2
    assert not result.passed
    assert "0 failed, none skipped, 2 not run" in result.summary


def test_few_random_devices_may_be_refused() -> None:
    good, refused = Verdict(RANDOM, "1", "m", PASSED), Verdict(RANDOM, "2", "m", REFUSED)
    assert StressResult("a.fmu", (good, refused), 1.0).passed
    assert not StressResult("a.fmu", (good, refused, refused), 1.0).passed
    on_axis = replace(refused, axis="mu")
    assert StressResult("a.fmu", (on_axis, on_axis, on_axis), 1.0).passed
