"""Fronts, the cheapest, and ratios."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from slider_resonator.trading.result import (
    AVERAGED,
    PEER,
    RESOLVED,
    Row,
    Trade,
    cheapest,
    front,
    paired_ratio,
)
from slider_resonator.trading.summary import duration, heading, sentence, standings


def row(cost: float, error: float, kind: str = RESOLVED, quantity: str = "position") -> Row:
    return Row(
        scene="s",
        answer="run",
        kind=kind,
        family=f"{kind} family",
        method=f"{kind} at {cost:g}",
        fidelity=None,
        friction_law=0,
        step=None,
        tolerance=None,
        periods=10,
        cpu=(0.9 * cost, cost, 1.2 * cost),
        start_cpu=None,
        steps=None,
        evaluations=None,
        events=None,
        errors={quantity: error},
    )


sizes = st.floats(1e-11, 1e3)


@given(st.lists(st.tuples(sizes, sizes), min_size=1, max_size=12))
def test_no_row_beats_the_front(points: list[tuple[float, float]]) -> None:
    rows = [row(*point) for point in points]
    best = front(rows, "position")
    for one in rows:
        in_front = any(
            b.cost <= one.cost and b.errors["position"] <= one.errors["position"] for b in best
        )
        assert in_front, "each row is on the front or beaten by one that is"
    costs = [b.cost for b in best]
    wrong = [b.errors["position"] for b in best]
    assert costs == sorted(costs)
    assert wrong == sorted(wrong, reverse=True)
    assert len(set(wrong)) == len(wrong)


def test_rounding_is_no_merit() -> None:
    rows = [row(1.0, 3e-14), row(2.0, 1e-14)]
    assert front(rows, "position") == rows[:1]


def test_the_cheapest_that_is_exact_enough() -> None:
    rows = [row(1.0, 1e-2), row(3.0, 1e-9), row(9.0, 1e-12)]
    assert cheapest(rows, "position", 1e-9) is rows[1]
    assert cheapest(rows, "position", 1e-13) is None
    assert cheapest(rows, "velocity", 1.0) is None, "none of them has a velocity"


def test_ratios_are_taken_repeat_by_repeat() -> None:
    middle, low, high = paired_ratio(row(3.0, 0.0), row(1.0, 0.0))
    assert (middle, low, high) == pytest.approx((3.0, 3.0, 3.0)), "a busy moment hits both alike"


def test_classes_are_compared_where_they_reach_the_error() -> None:
    rows = (
        row(1e-5, 1e-3, AVERAGED, "mean_velocity"),
        row(3e-4, 1e-13, RESOLVED, "mean_velocity"),
        row(6e-3, 1e-10, PEER, "mean_velocity"),
        row(1e-5, 1e-3, AVERAGED),
        row(3e-4, 1e-13, RESOLVED),
        row(6e-3, 1e-8, PEER),
    )
    found = standings(Trade("s", "S", 0, 10, 1.0, rows, ()))
    reported = {(s.quantity, s.kind): s for s in found}
    assert reported["mean_velocity", AVERAGED].ratio == pytest.approx((1 / 30,) * 3)
    assert reported["mean_velocity", PEER].ratio == pytest.approx((20.0,) * 3)
    assert sentence(reported["position", AVERAGED]) == "averages and leaps: not reached"
    assert sentence(reported["position", PEER]) == "peers: not reached"
    assert sentence(reported["position", RESOLVED]).startswith(
        "resolved: 300 us a simulated second"
    )
    assert "20 times the cost of resolved" in sentence(reported["mean_velocity", PEER])
    assert "30 times cheaper than resolved" in sentence(reported["mean_velocity", AVERAGED])
    assert heading("mean_velocity", 1e-2) == "at an error of 1 % in mean velocity"
    assert heading("position", 1e-9) == "at an error of 1e-09 in position"


def test_another_friction_law_is_no_candidate() -> None:
    lucky = replace(row(1e-6, 1e-12), friction_law=1)
    trade = Trade("s", "S", 0, 10, 1.0, (row(3e-4, 1e-13), lucky), ())
    (found,) = [s.row for s in standings(trade) if s.quantity == "position" and s.row is not None]
    assert found.friction_law == 0
    assert lucky in trade.having("position"), "its error is shown all the same"


@pytest.mark.parametrize(
    ("seconds", "words"),
    [
        (2.0, "2 s"),
        (1.5e-3, "1.5 ms"),
        (0.9996e-3, "1 ms"),
        (0.9994e-3, "999 us"),
        (3e-6, "3 us"),
        (4.2e-8, "42 ns"),
    ],
)
def test_durations_are_readable(seconds: float, words: str) -> None:
    assert duration(seconds) == words
