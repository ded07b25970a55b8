"""The FMU as a method: what a step and a fidelity cost in accuracy."""

from __future__ import annotations

from math import inf

import numpy as np
import pytest

from slider_resonator.fmu.instance import Instance
from slider_resonator.trading.fmu_methods import LEAP_TOLERANCES, STEPS, FmuMethods
from slider_resonator.trading.method import Method
from slider_resonator.trading.problem import Problem
from slider_resonator.trading.result import AVERAGED
from slider_resonator.trading.solution import errors
from tests.harness.in_process import InProcess
from tests.harness.trading.problems import LUGRE, RAMP, SCAN, TABLE_1, problem, reference_of


def followed(problem: Problem, method: Method) -> dict[str, float]:
    _, solution = method.run(problem.periods)
    return errors(problem, solution, reference_of(problem), problem.periods)


def pick(
    problem: Problem, instance: Instance, fidelity: int, step: float, order: int | None = None
) -> Method:
    methods = FmuMethods(problem, "native", InProcess(instance)).methods()
    return next(
        method
        for method in methods
        if (method.label.fidelity, method.label.step) == (fidelity, step)
        and method.label.averaging_order == order
        and "instead" not in method.label.name
    )


def test_a_ramp_that_is_passed_on_costs_nothing(instance: Instance) -> None:
    ramp = problem(RAMP)
    found = followed(ramp, pick(ramp, instance, 2, 10.0))
    assert max(found.values()) < 1e-11, f"steps of 10 periods: {found}"


def test_a_held_ramp_costs_the_first_power_of_the_step(
    instance: Instance, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(FmuMethods, "interpolates", False)
    ramp = problem(RAMP)
    steps = np.array([0.01, 0.1, 1.0])
    wrong = [followed(ramp, pick(ramp, instance, 2, step))["slow_displacement"] for step in steps]
    order = np.polyfit(np.log(steps), np.log(wrong), 1)[0]
    assert order == pytest.approx(1.0, abs=0.15), f"inputs lag half a step: {wrong}"


@pytest.mark.parametrize("law", [0, 1])
def test_a_drive_that_changes_costs_nothing(instance: Instance, law: int) -> None:
    scan = problem(f"{SCAN}[device]\nfriction_law = {law}\nbristle_stiffness = 1e4\n")
    for step in (0.1, 10.0):
        found = followed(scan, pick(scan, instance, 2, step))
        allowed = 1e-7 if law else 1e-10
        assert max(found.values()) < allowed, f"steps of {step:g} periods: {found}"


def test_under_constant_inputs_the_step_costs_nothing(instance: Instance) -> None:
    table_1 = problem(TABLE_1, max_periods=20)
    for step in (0.1, 1.0, 10.0):
        found = followed(table_1, pick(table_1, instance, 2, step))
        assert max(found.values()) < 1e-10, f"steps of {step:g} periods: {found}"


def test_averaged_motion_has_a_mean_velocity_and_no_events(instance: Instance) -> None:
    table_1 = problem(TABLE_1, max_periods=200)
    method = pick(table_1, instance, 0, 100.0, 1)
    found = followed(table_1, method)
    assert 1e-5 < found["mean_velocity"] < 2e-2, "averaging costs a share of the order of 1/3500"
    assert "event_times" not in found
    assert method.missing["event_times"] == "averages and leaps locate no events"
    assert method.label.kind == AVERAGED


def test_leaps_are_as_exact_as_their_tolerance(instance: Instance) -> None:
    table_1 = problem(TABLE_1, max_periods=200)
    found = followed(table_1, pick(table_1, instance, 0, 100.0, 2))
    assert found["mean_velocity"] < 1e-6
    assert found["position"] < 1e-6


def test_every_fidelity_step_and_law_is_there(instance: Instance) -> None:
    leaps = 1 + len(LEAP_TOLERANCES)
    for text, tolerances, averages in ((TABLE_1, 1, 1), (LUGRE, 5, leaps)):
        labels = [
            m.label for m in FmuMethods(problem(text), "native", InProcess(instance)).methods()
        ]
        assert len({label.name for label in labels}) == len(labels)
        for fidelity in (0, 1, 2):
            own = [label for label in labels if label.fidelity == fidelity]
            assert {label.step for label in own} == set(STEPS)
            assert {label.friction_law for label in own} == {0, 1}
            used = {label.tolerance for label in own if label.friction_law == 1}
            assert len(used) == (tolerances if fidelity else averages)


def test_answers_are_those_of_the_commands(instance: Instance) -> None:
    answers = list(FmuMethods(problem(TABLE_1), "native", InProcess(instance)).answers())
    found = {(a.label.name, a.quantity): a.find(inf)[1].value for a in answers}
    assert found["native FMU, fidelity 2", "steady_velocity"] == pytest.approx(0.126667, rel=1e-6)
    assert found["native FMU, fidelity 2", "blocking_force"] == pytest.approx(0.0851861, rel=1e-6)
    first, second = (
        found[f"native FMU, output steady_velocity, order {order}", "steady_velocity"]
        for order in (1, 2)
    )
    assert first == pytest.approx(0.126731, rel=1e-5)
    assert second == pytest.approx(0.12666699702, rel=1e-9)


def test_a_run_is_timed_without_its_readings(instance: Instance) -> None:
    table_1 = problem(TABLE_1, max_periods=10)
    assert pick(table_1, instance, 0, 10.0, 1).seconds(10) > 0.0
    _, solution = pick(table_1, instance, 2, 10.0).run(10)
    assert solution.steps == 1, "readings are no steps"
    assert solution.start_cpu is not None
