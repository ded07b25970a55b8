"""Runs of cases of the axes and of random devices, and their page.

Each passes, or is refused with name, value and requirement.
"""

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
from slider_resonator.stressing.axes import CHEAP, axis_cases
from slider_resonator.stressing.case import (
    MODELS,
    RANDOM,
    Case,
    Hold,
    Observation,
    name_of,
    observe,
)
from slider_resonator.stressing.comparisons import NO_REFERENCE, REFERENCE
from slider_resonator.stressing.invariants import BoundCheck
from slider_resonator.stressing.random_cases import random_case
from slider_resonator.stressing.report import write_stress_page
from slider_resonator.stressing.run import (
    FAILED,
    MAX_RELATIVE_COST,
    PASSED,
    REFUSED,
    SENSITIVE,
    StressResult,
    Verdict,
    applicable,
    judge,
    run_cases,
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
    assert "2 cases: 1 passed, 0 refused by name, 1 failed, 0 skipped" in result.summary
    assert f"--case '{ENDLESS.name}'" in "\n".join(result.sentences()), "to run it again"


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
        assert label.startswith(f"{1 + round(3 * share)} of 3: ")
        if share > 0.0:
            raise KeyboardInterrupt

    kept: list[StressResult] = []
    with pytest.raises(KeyboardInterrupt):
        run_cases(native_fmu, [QUICK, QUICK, QUICK], interrupt, 60.0, keep=kept.append)
    (result,) = kept
    assert [one.verdict for one in result.verdicts] == [PASSED]
    assert result.not_run == 2
    assert not result.passed
    assert "0 failed, 0 skipped, 2 not run" in result.summary


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


def test_cases_cover_what_they_should() -> None:
    cases = [random_case(0, number) for number in range(600)]
    assert Counter(case.model for case in cases).most_common()[-1][1] == 600 // len(MODELS)
    drives = [case.device.drive_frequency for case in cases]
    assert max(drives) / min(drives) > 1e3
    assert len({name for case in cases for hold in case.holds for name, _ in hold.tuned}) == 6
    assert any(case.device.normal_amplitude > case.device.normal_preload for case in cases)
    assert any(case.start_time for case in cases)
    assert all((case.sizes > 0.0).all() for case in cases)
    unequal = [case for case in cases if np.ptp(case.sizes) > 1e-3 * case.duration]
    assert len(unequal) > 300


@pytest.mark.parametrize("number", range(len(MODELS)))
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


@pytest.fixture(scope="module")
def cases() -> list[Case]:
    return list(axis_cases())


COVERED_BY_ALL = (
    *("beat against step", "start in flight", "late jump", "overflow", "Omega", "q", "alpha", "mu"),
    *("r_m", "xi", "neutral motions", "frequency ratio"),
)
COVERED_BY_CHEAP = ("resonance", "communication step", "grazing release")


def test_every_device_is_run_by_every_model_that_covers_it(cases: list[Case]) -> None:
    for axes, models in ((COVERED_BY_ALL, MODELS), (COVERED_BY_CHEAP, CHEAP)):
        for axis in axes:
            counts = Counter(case.value for case in cases if case.axis == axis)
            assert set(counts.values()) == {len(models)}, axis


def test_long_runs_are_asked_for(cases: list[Case]) -> None:
    added = {case.name for case in axis_cases(long=True)} - {case.name for case in cases}
    assert added == {
        *(f"drive periods: 1e+08: Coulomb, fidelity {n}" for n in (1, 2)),
        *(f"drive periods: 1e+06: LuGre, fidelity {n}" for n in (1, 2)),
    }


def test_names_are_unique() -> None:
    counts = Counter(case.name for case in axis_cases(long=True))
    assert [name for name, count in counts.items() if count > 1] == []


def test_other_steps_cover_the_same_times(cases: list[Case]) -> None:
    for case in cases:
        total = sum(hold.size * hold.count for hold in case.holds)
        other = sum(hold.size * hold.count for hold in case.other_holds)
        assert abs(other - total) <= 1e-12 * total, case.name
        assert case.other_holds != case.holds, case.name


LUGRE = {f"LuGre, fidelity {n}" for n in range(3)}
STEADY_FORCE = {f"{law}, fidelity {n}" for law in ("Coulomb", "LuGre") for n in range(2)}
STEADY_FORCE |= {"Coulomb, fidelity 0, order 2"}
UNDAMPED = ("drive at slip, xi 0", "drive 1 ulp below slip, xi 0", "drive 1 ulp above slip, xi 0")

WITHOUT_MEANING = {
    # Without friction a bristle bends at no rate (8).
    *(f"mu: 0: {model}" for model in (*LUGRE, "LuGre, fidelity 0, order 2")),
    *(f"free ringing: xi 0, mu 0: {model}" for model in LUGRE),
    # The steady force of an undamped resonator at its resonance is unbounded.
    *(f"resonance: {value}: {model}" for value in UNDAMPED for model in STEADY_FORCE),
    # Damper and bristles turn a slider of a nanogram within 1e-11 s.
    "r_m: 1 - 1e-9: LuGre, fidelity 2",
}


LONG_FOR_PYTHON = {
    *(f"communication step: 1e4 s: LuGre, fidelity {n}" for n in (1, 2)),
    "beat against step: 90 beats: LuGre, fidelity 0, order 2",
}
"""Steps that would take the Python FMU minutes: it refuses them by its bound of work."""


@pytest.mark.slow
@pytest.mark.parametrize(
    ("fmu", "every", "of_second_order", "too_long"),
    [("native_fmu", 7, 23, set()), ("python_fmu", 17, 41, LONG_FOR_PYTHON)],
)
def test_cases_of_the_axes(
    request: pytest.FixtureRequest, fmu: str, every: int, of_second_order: int, too_long: set[str]
) -> None:
    """One in `every` of each model; of those that leap, fewer."""
    cases: list[Case] = []
    for model in MODELS:
        own = [case for case in axis_cases() if case.model == model]
        cases += own[:: of_second_order if model.leaps else every]
    result = run_cases(request.getfixturevalue(fmu), cases, no_progress)
    assert [one.name for one in result.verdicts] == [case.name for case in cases], "none skipped"
    failed = [f"{one.name}: {one.reason}" for one in result.verdicts if one.verdict == FAILED]
    assert failed == []
    # Values that leave the range of numbers may be refused by name: that is what their axis tries.
    beyond = {case.name for case in cases if case.axis == "overflow"}
    refused = {one.name for one in result.verdicts if one.verdict == REFUSED} - beyond
    assert refused == (WITHOUT_MEANING | too_long) & {case.name for case in cases}
    has_reference = sum(check.name == REFERENCE for one in result.verdicts for check in one.checks)
    assert has_reference >= 0.6 * len(cases), "most cases have a reference"
    assert f"{has_reference} cases compared with a reference" in result.summary
    assert result.most_expensive is not None
    assert f"(bound {MAX_RELATIVE_COST:g})" in result.summary, "the worst cost of a step is printed"
    assert result.most_expensive.cost_ratio <= MAX_RELATIVE_COST
