from __future__ import annotations

from collections.abc import Mapping, Sequence

from studies.mutants.group_trials import Outcome, Try, rejected_members
from studies.mutants.trial import Rejection

FAULTY: Mapping[str, int] = {"c": 2, "f": 0, "h": 4}
"""Members that are rejected alone, by the point that does so."""
HIDES: Mapping[str, str] = {"a": "h"}
"""Members that keep another one from taking part."""
POINTS = range(5)


def rejections(
    attempt: Try[str], points: Mapping[str, Sequence[int]], order: Sequence[int]
) -> dict[str, Rejection]:
    """Return what is reported, which must be what is returned."""
    found: dict[str, Rejection] = {}
    assert rejected_members(attempt, points, order, found.__setitem__) == set(found)
    return found


class Scripted:
    """Tries that follow the tables above, and are counted."""

    def __init__(self) -> None:
        self.tried: list[tuple[str, ...]] = []

    def __call__(self, members: Sequence[str], points: Sequence[int]) -> Outcome[str]:
        self.tried.append(tuple(members))
        hidden = {HIDES[m] for m in members if m in HIDES}
        active = frozenset(members) - hidden
        passed: dict[int, frozenset[str]] = {}
        for point in points:
            if any(FAULTY.get(member) == point for member in active):
                return Outcome(Rejection(f"scene {point}", "position", "off"), point, passed)
            passed[point] = active
        return Outcome(None, None, passed)


def test_faulty_members_are_found_each_by_its_own_rejection() -> None:
    members = "abcdefgh"
    attempt = Scripted()
    found = rejections(attempt, {m: list(POINTS) for m in members}, POINTS)
    assert {m: r.scene for m, r in found.items()} == {m: f"scene {p}" for m, p in FAULTY.items()}
    for member in FAULTY:
        assert (member,) in attempt.tried, f"{member} must have been tried alone"
    assert ("g",) not in attempt.tried, "a half that passes clears all of its members"


def test_only_points_of_a_member_count() -> None:
    attempt = Scripted()
    assert rejections(attempt, {"b": [0, 1], "c": [0, 1]}, POINTS) == {}
    assert attempt.tried == [("b", "c")]


def test_members_that_only_fail_together_pass_and_others_stay_together() -> None:
    tried: list[str] = []

    def attempt(members: Sequence[str], points: Sequence[int]) -> Outcome[str]:
        tried.append("".join(members))
        everyone = frozenset(members)
        if {"b", "g"} <= everyone and 1 in points:
            return Outcome(Rejection("one", "", "both"), 1, {0: everyone})
        if "g" in everyone and 3 in points:
            return Outcome(Rejection("three", "", "g"), 3, dict.fromkeys(points[:-2], everyone))
        return Outcome(None, None, dict.fromkeys(points, everyone))

    points = {m: list(POINTS) for m in "abcdefgh"}
    for passed_before in "bg":
        points[passed_before] = [0, 2, 3, 4]
    found = rejections(attempt, points, POINTS)
    assert {m: r.scene for m, r in found.items()} == {"g": "three"}, "only g fails alone"
    assert tried.count("abcdefgh") == 3, "those that fail together at 1 go on together"


def test_a_sum_of_small_changes_costs_a_few_trials() -> None:
    sizes: list[int] = []

    def attempt(members: Sequence[str], points: Sequence[int]) -> Outcome[str]:
        sizes.append(len(members))
        everyone = frozenset(members)
        if len(members) > 6 and 2 in points:  # together they exceed a bound
            return Outcome(Rejection("two", "", "sum"), 2, dict.fromkeys(points[:2], everyone))
        return Outcome(None, None, dict.fromkeys(points, everyone))

    points = {m: list(POINTS) for m in "abcdefghijklmnopqrstuvwx"}
    assert rejections(attempt, points, POINTS) == {}
    assert sizes == [24, 24, 12, 6, 6, 12, 6, 6, 24], "quarters pass at 2, all at the rest"


def test_one_that_is_tried_with_others_is_not_rejected_for_them() -> None:
    def attempt(members: Sequence[str], points: Sequence[int]) -> Outcome[str]:
        everyone = frozenset(members)
        if {"a", "b"} <= everyone and 1 in points:
            return Outcome(Rejection("one", "", "both"), 1, {})
        return Outcome(None, None, dict.fromkeys(points, everyone))

    assert rejections(attempt, {"a": [0], "b": [0], "c": [0, 1]}, POINTS) == {}


def test_a_rejection_before_any_point_is_looked_for_at_the_first() -> None:
    def attempt(members: Sequence[str], points: Sequence[int]) -> Outcome[str]:
        if "b" in members:
            return Outcome(Rejection("", "", "cannot be loaded"), None, {})
        return Outcome(None, None, dict.fromkeys(points, frozenset(members)))

    found = rejections(attempt, {m: [3, 4] for m in "abc"}, [3, 4])
    assert list(found) == ["b"]
