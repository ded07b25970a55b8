"""The FMU as a method, and methods measured: each is a row or an omission."""

from collections.abc import Callable
from math import inf

import numpy as np
import pytest

from slider_resonator.fmu.instance import Instance
from slider_resonator.output.progress import no_progress
from slider_resonator.trading import measure
from slider_resonator.trading.fmu_methods import FmuMethods
from slider_resonator.trading.measure import measure_trade
from slider_resonator.trading.problem import Problem
from slider_resonator.trading.result import PEER, Row
from slider_resonator.trading.solution import Method, Solution, errors
from tests.harness.in_process import InProcess
from tests.harness.trading.problems import RAMP, SCAN, STICKING, TABLE_1, problem, reference_of


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
        if (method.row.fidelity, method.row.step) == (fidelity, step)
        and method.row.averaging_order == order
        and "instead" not in method.row.method
    )


def test_a_ramp_that_is_passed_on_costs_nothing(instance: Instance) -> None:
    ramp = problem(RAMP)
    found = followed(ramp, pick(ramp, instance, 2, 10.0))
    assert max(found.values()) < 1e-11, f"steps of 10 periods: {found}"


def test_held_ramp_is_of_order_1(instance: Instance, monkeypatch: pytest.MonkeyPatch) -> None:
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


def test_answers_are_those_of_the_commands(instance: Instance) -> None:
    answers = list(FmuMethods(problem(TABLE_1), "native", InProcess(instance)).answers())
    found = {(a.row.method, a.row.answer): a.find(inf).value for a in answers}
    assert found["native FMU, fidelity 2", "steady_velocity"] == pytest.approx(0.126667, rel=1e-6)
    assert found["native FMU, fidelity 2", "blocking_force"] == pytest.approx(0.0851861, rel=1e-6)
    first, second = (
        found[f"native FMU, output steady_velocity, order {order}", "steady_velocity"]
        for order in (1, 2)
    )
    assert first == pytest.approx(0.126731, rel=1e-5)
    assert second == pytest.approx(0.12666699702, rel=1e-9)


def made_up(
    name: str, follow: Callable[[int], Solution], cost: float = 0.0, **fields: bool
) -> Method:
    def run(periods: int) -> tuple[float, Solution]:
        return cost * periods, follow(periods)

    def seconds(periods: int) -> float:
        run(periods)
        return 1e-3 * periods

    return Method(Row(PEER, name, name, 0), run, seconds, **fields)  # type: ignore[arg-type]


def only(monkeypatch: pytest.MonkeyPatch, *methods: Method) -> None:
    monkeypatch.setattr(measure, "peer_methods", lambda problem: list(methods))
    monkeypatch.setattr(measure, "peer_answers", lambda problem: [])


def still(problem: Problem) -> Callable[[int], Solution]:
    def run(periods: int) -> Solution:
        times = problem.readings(periods)
        return Solution(times, 0.0 * times, 0.0 * times)

    return run


def test_a_failing_method_is_omitted_with_the_reason(monkeypatch: pytest.MonkeyPatch) -> None:
    short = problem(TABLE_1, max_periods=4)

    def fails(periods: int) -> Solution:
        raise RuntimeError("the solver gives up")

    only(monkeypatch, made_up("failing", fails), made_up("standing", still(short)))
    trade = measure_trade(short, {}, no_progress, repeats=3)
    (row,) = trade.rows
    assert row.method == "standing"
    assert row.cpu == pytest.approx((1e-3 / short.period,) * 3), "per simulated second"
    assert row.errors["position"] == pytest.approx(1.0), "it misses the whole motion"
    reported = {(o.method, o.quantity): o.reason for o in trade.omissions}
    assert reported["failing", "all"] == "the solver gives up"
    assert ("standing", "event_times") in reported


def test_a_method_stops_where_its_budget_ends(monkeypatch: pytest.MonkeyPatch) -> None:
    longer = problem(TABLE_1, max_periods=64)
    slow = made_up("slow", still(longer), 0.1)
    only(monkeypatch, slow, made_up("far too slow", still(longer), 10.0))
    trade = measure_trade(longer, {}, no_progress, repeats=5, budget=1.0)
    (row,) = trade.rows
    assert row.periods == 8, "8 periods take 0.8 s, 16 would take 1.6 s of the 1 s"
    assert len(row.cpu) == 1, "nor are there repeats beyond the budget"
    reported = {(o.method, o.quantity): o.reason for o in trade.omissions}
    assert "followed over 8 of 64 drive periods" in reported["slow", "length"]
    assert "more than its budget of 1 s" in reported["far too slow", "all"]


def test_method_that_cannot_stick_is_omitted(monkeypatch: pytest.MonkeyPatch) -> None:
    sticking = problem(STICKING, max_periods=4)
    only(monkeypatch, made_up("sliding", still(sticking), cannot_stick=True))
    trade = measure_trade(sticking, {}, no_progress, repeats=1)
    assert [(o.method, o.quantity) for o in trade.omissions] == [("sliding", "all")]
    assert "sticks" in trade.omissions[0].reason
