"""The cases of the axes: each passes, or is refused with name, value and requirement."""

from collections import Counter
from collections.abc import Set
from pathlib import Path

import pytest

from slider_resonator.output.progress import no_progress
from slider_resonator.stressing.axes import CHEAP, axis_cases
from slider_resonator.stressing.case import MODELS, Case
from slider_resonator.stressing.run import MAX_RELATIVE_COST, StressResult, run_cases
from slider_resonator.stressing.verdict import FAILED, REFERENCE, REFUSED


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


EVERY, EVERY_OF_SECOND_ORDER = 17, 41
"""Of how many cases of a model the Python FMU runs one, and of those that leap."""
NATIVE, NATIVE_OF_SECOND_ORDER = 7, 23
"""The same for the native FMU."""

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


def cases_in_part(every: int, of_second_order: int) -> list[Case]:
    """Return one case in so many of each model."""
    return [
        case
        for model in MODELS
        for case in [one for one in axis_cases() if one.model == model][
            :: of_second_order if model.leaps else every
        ]
    ]


def judged(fmu: Path, cases: list[Case], too_long: Set[str] = frozenset()) -> StressResult:
    result = run_cases(fmu, cases, no_progress)
    failed = [f"{one.name}: {one.reason}" for one in result.verdicts if one.verdict == FAILED]
    assert failed == []
    assert [one.name for one in result.verdicts] == [case.name for case in cases], "none skipped"
    # Values that leave the range of numbers may be refused by name: that is what their axis tries.
    beyond = {case.name for case in cases if case.axis == "overflow"}
    refused = {one.name for one in result.verdicts if one.verdict == REFUSED} - beyond
    assert refused == (WITHOUT_MEANING | too_long) & {case.name for case in cases}
    return result


@pytest.mark.slow
def test_native(native_fmu: Path) -> None:
    cases = cases_in_part(NATIVE, NATIVE_OF_SECOND_ORDER)
    result = judged(native_fmu, cases)
    assert sum(result.counts.values()) == len(cases)
    has_reference = sum(check.name == REFERENCE for one in result.verdicts for check in one.checks)
    assert has_reference >= 0.6 * len(cases), "most cases have a reference"
    assert f"{has_reference} cases compared with a reference" in result.summary
    assert result.most_expensive is not None
    assert f"(bound {MAX_RELATIVE_COST:g})" in result.summary, "the worst cost of a step is printed"
    assert result.most_expensive.cost_ratio <= MAX_RELATIVE_COST


@pytest.mark.slow
def test_python(python_fmu: Path) -> None:
    judged(python_fmu, cases_in_part(EVERY, EVERY_OF_SECOND_ORDER), LONG_FOR_PYTHON)
