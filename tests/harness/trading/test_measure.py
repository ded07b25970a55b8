"""Every method is a row or an omission, whatever happens."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from slider_resonator.trading import measure
from slider_resonator.trading.measure import measure_trade
from slider_resonator.trading.method import Label, Method
from slider_resonator.trading.problem import Problem
from slider_resonator.trading.result import PEER
from slider_resonator.trading.solution import Solution
from tests.harness.trading.problems import STICKING, TABLE_1, problem


def quiet(name: str, share: float) -> None:
    assert 0.0 <= share <= 1.0


def made_up(
    name: str, follow: Callable[[int], Solution], cost: float = 0.0, **fields: bool
) -> Method:
    def run(periods: int) -> tuple[float, Solution]:
        return cost * periods, follow(periods)

    def seconds(periods: int) -> float:
        run(periods)
        return 1e-3 * periods

    return Method(Label(PEER, name, name, 0), run, seconds, **fields)  # type: ignore[arg-type]


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
    trade = measure_trade(short, {}, quiet, repeats=3)
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
    trade = measure_trade(longer, {}, quiet, repeats=5, budget=1.0)
    (row,) = trade.rows
    assert row.periods == 8, "8 periods take 0.8 s, 16 would take 1.6 s of the 1 s"
    assert len(row.cpu) == 1, "nor are there repeats beyond the budget"
    reported = {(o.method, o.quantity): o.reason for o in trade.omissions}
    assert "followed over 8 of 64 drive periods" in reported["slow", "length"]
    assert "more than its budget of 1 s" in reported["far too slow", "all"]


def test_a_method_that_cannot_stick_is_omitted_where_the_slider_sticks(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    sticking = problem(STICKING, max_periods=4)
    only(monkeypatch, made_up("sliding", still(sticking), cannot_stick=True))
    trade = measure_trade(sticking, {}, quiet, repeats=1)
    assert [(o.method, o.quantity) for o in trade.omissions] == [("sliding", "all")]
    assert "sticks" in trade.omissions[0].reason
