"""Times taken in turn."""

from __future__ import annotations

from slider_resonator.trading.measure import Timed, in_turn


def test_each_work_is_timed_once_in_each_round() -> None:
    order: list[str] = []

    def timed(name: str, repeats: int) -> Timed:
        def seconds() -> float:
            order.append(name)
            return float(len(order))

        return Timed(name, seconds, repeats)

    reported: list[float] = []
    found = in_turn([timed("a", 3), timed("b", 1), timed("c", 2)], lambda _, s: reported.append(s))
    assert order == ["a", "b", "c", "a", "c", "a"], "round after round, while repeats are left"
    assert found == [[1.0, 4.0, 6.0], [2.0], [3.0, 5.0]]
    assert reported == sorted(reported)
    assert in_turn([]) == []
