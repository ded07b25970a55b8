from dataclasses import replace

import pytest

from slider_resonator.device.interface import OUTPUTS
from slider_resonator.device.model import Model
from slider_resonator.fmu.instance import Instance
from slider_resonator.stressing.axes import axis_cases
from slider_resonator.stressing.case import Case, Hold, Observation, observe
from slider_resonator.stressing.comparisons import REFERENCE, REFERENCE_ERROR, has_reference
from slider_resonator.stressing.run import FAILED, MAX_RELATIVE_COST, PASSED, REFUSED, judge

HOLDS = (Hold(1e-4, 60),)
RINGING = {"base_amplitude": 0.0, "damping_ratio": 0.0, "friction_coefficient": 0.0}
RINGING["initial_resonator_displacement"] = 1e-4
CASES = {
    case.value: case
    for case in (
        Case("sound", "table 1", Model(2, 0), {}, HOLDS),
        Case("sound", "ringing", Model(2, 0), RINGING, HOLDS),
        Case("sound", "tolerance 1e-2", Model(2, 1), {"tolerance": 1e-2}, HOLDS),
        Case("sound", "tolerance 1e-6", Model(2, 1), {"tolerance": 1e-6}, HOLDS),
        Case("sound", "averages", Model(0, 0, 1), {}, (Hold(0.01, 20, load=0.02),)),
        Case("sound", "leaps", Model(0, 0, 2), {}, (Hold(0.15, 4, load=0.02),)),
    )
}


@pytest.fixture(scope="module")
def observed(instance: Instance) -> dict[str, Observation]:
    return {name: observe(instance, case) for name, case in CASES.items()}


@pytest.fixture
def seen(observed: dict[str, Observation]) -> Observation:
    return observed["table 1"]


@pytest.mark.parametrize("name", CASES)
def test_a_sound_motion_passes(observed: dict[str, Observation], name: str) -> None:
    verdict = judge(CASES[name], observed[name])
    assert verdict.verdict == PASSED, verdict.reason
    found = {check.name: check.found for check in verdict.checks}
    assert {"phase of the normal load", REFERENCE} <= set(found)
    assert "momentum" in found or name.startswith("tolerance")
    assert found[REFERENCE] < {"averages": 0.2}.get(name, 1.0)


@pytest.mark.parametrize(
    ("case", "name", "change", "check"),
    [
        *(("table 1", name, float("nan"), "finite") for name in OUTPUTS),
        ("table 1", "steady_velocity", float("inf"), "finite"),
        ("table 1", "normal_force", 1e-6, "phase of the normal load"),
        ("table 1", "friction_force", 1.0, "friction bound"),
        ("table 1", "velocity", 0.1, "momentum"),
        ("table 1", "velocity", 1e-7, "reference"),
        ("table 1", "position", 1e-9, "other steps"),
        ("table 1", "stick_fraction", 1.5, "counts and shares"),
        ("table 1", "reversals", -100.0, "counts and shares"),
        ("ringing", "resonator_displacement", 1e-6, "energy"),
        # Twice the tolerance, of a peak of 1.993 m/s.
        ("tolerance 1e-2", "resonator_velocity", 0.0398, "reference"),
        ("tolerance 1e-6", "resonator_velocity", 3.98e-6, "reference"),
        # v_q of table 1 and some of the path in 0.2 s; momentum alone bounds neither.
        ("averages", "mean_velocity", 3.0 * REFERENCE_ERROR * 0.2366, "reference"),
        ("averages", "position", 3.0 * REFERENCE_ERROR * 0.02, "reference"),
        ("leaps", "velocity", 1e-5, "reference"),
        ("leaps", "position", 1e-5, "reference"),
    ],
)
def test_a_wrong_motion_fails(
    observed: dict[str, Observation], case: str, name: str, change: float, check: str
) -> None:
    """What is wrong is one output at the last point."""
    signal = observed[case].outputs[name].copy()
    signal[-1] += change
    wrong = replace(observed[case], outputs={**observed[case].outputs, name: signal})
    verdict = judge(CASES[case], wrong)
    assert verdict.verdict == FAILED
    assert check in verdict.reason, "the reason names the bound that was broken"


def test_a_replay_that_differs_fails(seen: Observation) -> None:
    assert "replay" in judge(CASES["table 1"], replace(seen, replayed=False)).reason


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
    assert judge(CASES["table 1"], replace(seen, refusal=words)).verdict == verdict


def test_a_step_that_costs_too_much_fails(seen: Observation) -> None:
    expensive = replace(seen, worst_step=2.0 * MAX_RELATIVE_COST * seen.period_cost)
    assert "cost of a step" in judge(CASES["table 1"], expensive).reason


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
