"""Measuring: everybody is in a row or among the omissions, whatever happens."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from slider_resonator.studies.trade import measure
from slider_resonator.studies.trade.measure import measure_trade
from slider_resonator.studies.trade.method import Label, Method
from slider_resonator.studies.trade.motion import Motion
from slider_resonator.studies.trade.result import PEER
from slider_resonator.studies.trade.task import Task
from tests.harness.studies.trade.scenes import STICKING, TABLE_1, task


def quiet(name: str, share: float) -> None:
    assert 0.0 <= share <= 1.0


def made_up(name: str, run: Callable[[int], Motion], **fields: bool) -> Method:
    def seconds(periods: int) -> float:
        run(periods)
        return 1e-3 * periods

    return Method(Label(PEER, name, name, 0), run, seconds, **fields)  # type: ignore[arg-type]


def only(monkeypatch: pytest.MonkeyPatch, *methods: Method) -> None:
    monkeypatch.setattr(measure, "peer_methods", lambda task: list(methods))
    monkeypatch.setattr(measure, "peer_answers", lambda task: [])


def still(task: Task) -> Callable[[int], Motion]:
    def run(periods: int) -> Motion:
        times = task.readings(periods)
        return Motion(times, 0.0 * times, 0.0 * times)

    return run


def test_who_fails_is_told_with_the_reason(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    short = task(tmp_path, TABLE_1, most_periods=4)

    def fails(periods: int) -> Motion:
        raise RuntimeError("the solver gives up")

    only(monkeypatch, made_up("failing", fails), made_up("standing", still(short)))
    trade = measure_trade(short, {}, quiet, repeats=3)
    (row,) = trade.rows
    assert row.method == "standing"
    assert row.cpu == pytest.approx((1e-3 / short.period,) * 3), "per simulated second"
    assert row.errors["position"] == pytest.approx(1.0), "it misses the whole motion"
    told = {(o.method, o.quantity): o.reason for o in trade.omissions}
    assert told["failing", "all"] == "the solver gives up"
    assert ("standing", "event_times") in told


def test_a_method_stops_where_its_budget_ends(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    longer = task(tmp_path, TABLE_1, most_periods=64)
    used = [0.0]
    monkeypatch.setattr(measure, "process_time", lambda: used[0])

    def works(cost: float) -> Callable[[int], Motion]:
        def run(periods: int) -> Motion:
            used[0] += cost * periods
            return still(longer)(periods)

        return run

    only(monkeypatch, made_up("slow", works(0.1)), made_up("far too slow", works(10.0)))
    trade = measure_trade(longer, {}, quiet, repeats=5, budget=1.0)
    (row,) = trade.rows
    assert row.periods == 8, "8 periods take 0.8 s, 16 would take 1.6 s of the 1 s"
    assert len(row.cpu) == 1, "nor are there repeats beyond the budget"
    told = {(o.method, o.quantity): o.reason for o in trade.omissions}
    assert "followed over 8 of 64 drive periods" in told["slow", "length"]
    assert "more than its budget of 1 s" in told["far too slow", "all"]


def test_who_covers_no_sticking_is_left_out_where_it_sticks(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    sticking = task(tmp_path, STICKING, most_periods=4)
    only(monkeypatch, made_up("sliding", still(sticking), sticks_not=True))
    trade = measure_trade(sticking, {}, quiet, repeats=1)
    assert [(o.method, o.quantity) for o in trade.omissions] == [("sliding", "all")]
    assert "sticks" in trade.omissions[0].reason
