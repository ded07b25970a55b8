from dataclasses import replace

import numpy as np
import pytest

from slider_resonator.device.interface import OUTPUTS
from slider_resonator.device.model import Model
from slider_resonator.fmu.instance import Instance
from slider_resonator.stressing.axes import axis_cases
from slider_resonator.stressing.case import Case, Hold
from slider_resonator.stressing.comparisons import REFERENCE_ERROR, has_reference
from slider_resonator.stressing.observe import Observation, observe
from slider_resonator.stressing.run import MAX_RELATIVE_COST, judge
from slider_resonator.stressing.verdict import FAILED, PASSED, REFERENCE, REFUSED

TABLE_1 = Case("table 1", "as it is", Model(2, 0), {}, (Hold(1e-4, 60),))


@pytest.fixture(scope="module")
def seen(instance: Instance) -> Observation:
    return observe(instance, TABLE_1)


def changed(seen: Observation, name: str, change: float) -> Observation:
    """Add to one output, at the last point only."""
    signal = seen.outputs[name].copy()
    signal[-1] += change
    return replace(seen, outputs={**seen.outputs, name: signal})


def test_table_1_passes(seen: Observation) -> None:
    verdict = judge(TABLE_1, seen)
    assert verdict.verdict == PASSED, verdict.reason
    assert {"momentum", "phase of the normal load", "reference"} <= {c.name for c in verdict.checks}


@pytest.mark.parametrize(
    ("name", "change", "check"),
    [
        *((name, float("nan"), "finite") for name in OUTPUTS),
        ("steady_velocity", float("inf"), "finite"),
        ("normal_force", 1e-6, "phase of the normal load"),
        ("friction_force", 1.0, "friction bound"),
        ("velocity", 0.1, "momentum"),
        ("velocity", 1e-7, "reference"),
        ("position", 1e-9, "other steps"),
        ("stick_fraction", 1.5, "counts and shares"),
        ("reversals", -100.0, "counts and shares"),
    ],
)
def test_a_wrong_motion_fails(seen: Observation, name: str, change: float, check: str) -> None:
    verdict = judge(TABLE_1, changed(seen, name, change))
    assert verdict.verdict == FAILED
    assert check in verdict.reason, "the reason names the bound that was broken"


def test_energy_must_not_grow(instance: Instance) -> None:
    free = {"base_amplitude": 0.0, "damping_ratio": 0.0, "friction_coefficient": 0.0}
    parameters = {**free, "initial_resonator_displacement": 1e-4}
    case = Case("free", "ringing", Model(2, 0), parameters, (Hold(1e-4, 60),))
    rung = observe(instance, case)
    assert judge(case, rung).verdict == PASSED, "an undamped resonator keeps its energy"
    verdict = judge(case, changed(rung, "resonator_displacement", 1e-6))
    assert "energy" in verdict.reason


def test_a_replay_that_differs_fails(seen: Observation) -> None:
    assert "replay" in judge(TABLE_1, replace(seen, replayed=False)).reason


@pytest.mark.parametrize(
    ("words", "verdict"),
    [
        ("x.fmu: load = 0.0 refused: must be a finite number", REFUSED),
        ("base_amplitude = 0.0001 refused: must be a finite number of at least 0 m", REFUSED),
        ("doStep: communicationStepSize = 0.0001 refused: more than 9; must be less", REFUSED),
        ("x.fmu: fmi2DoStep failed with status 3 (error).", FAILED),
        ("the parameters are refused: must be smaller", FAILED),
        ("base_amplitude = 0.0001 refused", FAILED),
        ("base_amplitude = 1.0 refused: must be a finite number of at least 0 m", FAILED),
        ("doStep: communicationStepSize = 7.0 refused: must be a finite number above 0", FAILED),
        ("a finer fidelity refused: must be 1 or 2", FAILED),
    ],
)
def test_refusal_names_value_and_requirement(seen: Observation, words: str, verdict: str) -> None:
    assert judge(TABLE_1, replace(seen, refusal=words)).verdict == verdict


def test_a_step_that_costs_too_much_fails(seen: Observation) -> None:
    expensive = replace(seen, worst_step=2.0 * MAX_RELATIVE_COST * seen.period_cost)
    assert "cost of a step" in judge(TABLE_1, expensive).reason


@pytest.mark.parametrize("tolerance", [1e-2, 1e-6])
def test_a_tolerance_is_a_bound(instance: Instance, tolerance: float) -> None:
    parameters = {"tolerance": tolerance}
    case = Case("tolerance", "as it is", Model(2, 1), parameters, (Hold(1e-4, 60),))
    rung = observe(instance, case)
    assert judge(case, rung).verdict == PASSED
    peak = float(np.abs(rung.outputs["resonator_velocity"]).max())
    verdict = judge(case, changed(rung, "resonator_velocity", 2.0 * tolerance * peak))
    assert "reference" in verdict.reason, "twice the tolerance is too much"


AVERAGED = Case("table 1", "averaged", Model(0, 0, 1), {}, (Hold(0.01, 20, load=0.02),))
LEAPS = Case("table 1", "order 2", Model(0, 0, 2), {}, (Hold(0.15, 4, load=0.02),))


@pytest.mark.parametrize(
    ("case", "share", "changes"),
    [
        # v_q of table 1 and some of the path in 0.2 s; momentum alone bounds neither.
        (
            *(AVERAGED, 0.2),
            {
                "mean_velocity": 3.0 * REFERENCE_ERROR * 0.2366,
                "position": 3.0 * REFERENCE_ERROR * 0.02,
            },
        ),
        (LEAPS, 1.0, {"velocity": 1e-5, "position": 1e-5}),
    ],
)
def test_averaged_motion_agrees_with_its_reference(
    instance: Instance, case: Case, share: float, changes: dict[str, float]
) -> None:
    """A motion that is slightly off does not."""
    seen = observe(instance, case)
    verdict = judge(case, seen)
    assert verdict.verdict == PASSED, verdict.reason
    (check,) = [check for check in verdict.checks if check.name == REFERENCE]
    assert 0.0 < check.found < share
    for name, change in changes.items():
        wrong = judge(case, changed(seen, name, change))
        assert wrong.verdict == FAILED, name
        assert "reference" in wrong.reason, name


@pytest.mark.parametrize(
    ("models", "share", "axes"),
    [
        (
            {Model(0, 0, 1), Model(0, 1, 1)},
            0.8,
            {"Omega", "xi", "critical damping", "frequency ratio", "blocking load"},
        ),
        (
            {Model(0, 0, 2), Model(0, 1, 2)},
            0.6,
            {"Omega", "blocking load", "neutral motions", "start in flight"},
        ),
    ],
)
def test_most_averages_have_a_reference(models: set[Model], share: float, axes: set[str]) -> None:
    cases = [case for case in axis_cases() if case.model in models]
    assert sum(map(has_reference, cases)) > share * len(cases)
    assert not {case.axis for case in cases if not has_reference(case)} & axes
