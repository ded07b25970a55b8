"""The order in which times are taken."""

from __future__ import annotations

from slider_resonator.trading.measure import in_turn


def test_each_work_is_timed_once_in_each_round() -> None:
    assert in_turn([3, 1, 2]) == [0, 1, 2, 0, 2, 0], "round after round, while repeats are left"
    assert in_turn([]) == []
