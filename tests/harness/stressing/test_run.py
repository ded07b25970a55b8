"""Runs of cases, their random devices, and their page."""

from collections import Counter
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from slider_resonator.device.model import Model
from slider_resonator.errors import FmuError
from slider_resonator.fmu.instance import Instance
from slider_resonator.output.progress import no_progress
from slider_resonator.stressing import comparisons
from slider_resonator.stressing.case import RANDOM, Case, Hold, name_of
from slider_resonator.stressing.observe import Observation, observe
from slider_resonator.stressing.random_cases import IN_TURN, random_case
from slider_resonator.stressing.report import write_stress_page
from slider_resonator.stressing.run import StressResult, applicable, judge, run_cases
from slider_resonator.stressing.verdict import (
    FAILED,
    NO_REFERENCE,
    PASSED,
    REFERENCE,
    REFUSED,
    SENSITIVE,
    BoundCheck,
    Verdict,
)
from tests.harness.faulty_fmus import compiled, without_later_variables
from tests.harness.golden import assert_page_as_before
from tests.harness.known_provenance import PROVENANCE

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
    cases = [replace(QUICK, value=str(n)) for n in range(2)]
    result = run_cases(crash, cases, no_progress, 20.0)
    assert [one.verdict for one in result.verdicts] == [FAILED] * 2
    assert all("crashed in fmi2DoStep" in one.reason for one in result.verdicts)


def test_cases_with_variables_that_it_lacks_are_skipped(native_fmu: Path, tmp_path: Path) -> None:
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


RESOLVED, SLOW = name_of(Model(2, 0)), name_of(Model(0, 1, 2))
CHECKS = (BoundCheck("momentum", 1e-3), BoundCheck(REFERENCE, 0.5))
FAR = (BoundCheck(REFERENCE, float("inf"), "velocity off"),)
VERDICTS = (
    Verdict("q & r", "1e3", RESOLVED, PASSED, "", CHECKS, 1e-6, 1e-6),
    Verdict("q & r", "1e6", RESOLVED, FAILED, "it <flies>"),
    Verdict("q & r", "1e6", SLOW, REFUSED, "load refused"),
    Verdict(RANDOM, "seed 3, case 4", SLOW, SENSITIVE, "the reference departs", FAR),
    Verdict(RANDOM, "seed 3, case 5", SLOW, NO_REFERENCE, "gave up"),
)
RESULT = StressResult("some place/my.fmu", VERDICTS, 3.0)


def test_the_page_has_each_case_with_its_checks_or_command(tmp_path: Path) -> None:
    """Of a whole run, of one without failures so far, and of one that failed before its end."""
    so_far = replace(RESULT, fmu="b.fmu", verdicts=VERDICTS[::2], not_run=1)
    failed = replace(RESULT, fmu="c.fmu", verdicts=VERDICTS[1:2], not_run=1)
    page = tmp_path / "index.html"
    write_stress_page(page, [RESULT, so_far, failed], PROVENANCE)
    assert_page_as_before("stress.html", page)


def test_the_first_cases_pass(python_fmu: Path) -> None:
    """Others are run on the native FMU below."""
    reported: list[tuple[str, float]] = []
    cases = [random_case(7, number) for number in range(len(IN_TURN))]
    result = run_cases(python_fmu, cases, lambda label, share: reported.append((label, share)))
    assert result.passed, "\n".join(result.sentences())
    assert [share for _, share in reported] == sorted(share for _, share in reported)
    assert len(reported) == len(cases)
    assert reported[-1][0].startswith(f"{len(cases)} of {len(cases)}: ")
    assert {one.verdict for one in result.verdicts} == {PASSED}


def test_cases_cover_what_they_should() -> None:
    cases = [random_case(0, number) for number in range(600)]
    assert Counter(case.model for case in cases).most_common()[-1][1] == 600 // len(IN_TURN)
    drives = [case.device.drive_frequency for case in cases]
    assert max(drives) / min(drives) > 1e3
    assert len({name for case in cases for hold in case.holds for name, _ in hold.tuned}) == 6
    assert any(case.device.normal_amplitude > case.device.normal_preload for case in cases)
    assert any(case.start_time for case in cases)
    assert all((case.sizes > 0.0).all() for case in cases)
    unequal = [case for case in cases if np.ptp(case.sizes) > 1e-3 * case.duration]
    assert len(unequal) > 300


@pytest.mark.parametrize("number", range(len(IN_TURN)))
def test_an_error_above_the_bound_fails(instance: Instance, number: int) -> None:
    case = random_case(7, number)
    seen = observe(instance, case)
    assert judge(case, seen).verdict == PASSED
    position = seen.outputs["position"]
    off = position + 1e-2 * max(float(np.abs(position).max()), 1e-9)
    verdict = judge(case, replace(seen, outputs={**seen.outputs, "position": off}))
    assert verdict.verdict == FAILED
    assert "reference: " in verdict.reason


def test_a_device_without_reference_is_not_judged() -> None:
    case = random_case(7, 2)
    w = case.device.drive_frequency
    undamped = {"damping_ratio": 0.0, "resonator_mass": 0.0, "resonator_frequency": w}
    still = replace(
        case,
        parameters={**case.parameters, **undamped},
        holds=tuple(replace(hold, tuned=()) for hold in case.holds),
    )
    assert judge(still, Observation()).verdict == NO_REFERENCE


def test_sensitive_motion(instance: Instance, monkeypatch: pytest.MonkeyPatch) -> None:
    case = random_case(7, 0)
    seen = observe(instance, case)
    wrong = replace(seen, outputs={name: 1.001 * one for name, one in seen.outputs.items()})
    assert judge(case, wrong).verdict == FAILED
    monkeypatch.setattr(comparisons, "CONDITIONING", 1e12)
    assert judge(case, wrong).verdict == SENSITIVE
