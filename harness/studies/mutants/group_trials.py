"""Clear many variants of an FMU at once, and find those among them that are rejected.

Most variants that pass the first scenes pass all. So several are put into one FMU. Where it passes,
each has passed whose changed statement was executed; where it is rejected, halves are tried, down
to one: a rejection is always that of one variant alone, and variants that fail together only have
passed in halves. Those whose statements others kept from being executed are tried again with fewer.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Generic, TypeVar

from studies.mutants.trial import Rejection

Member = TypeVar("Member")


@dataclass(frozen=True)
class Outcome(Generic[Member]):
    """What came of some members in one FMU: their rejection `at` a point, or before any for None.

    `passed` has, for each point passed, the members that took part.
    """

    rejection: Rejection | None
    at: int | None
    passed: Mapping[int, frozenset[Member]]


Try = Callable[[Sequence[Member], Sequence[int]], Outcome[Member]]
"""Try members in one FMU at points, in order, up to a rejection."""


def rejected_members(
    attempt: Try[Member],
    points: Mapping[Member, Sequence[int]],
    order: Sequence[int],
    report: Callable[[Member, Rejection], None],
) -> set[Member]:
    """Return the members that are rejected at one of their `points`, tried in the given order.

    `report` is called with each and its rejection as soon as it is found.
    """
    rejected: set[Member] = set()
    hidden: dict[Member, list[int]] = {}

    def tried(members: Sequence[Member], at: Sequence[int]) -> Outcome[Member]:
        outcome = attempt(members, at)
        for point, took_part in outcome.passed.items():
            for member in members if len(members) > 1 else ():
                if point in points[member] and member not in took_part:
                    hidden.setdefault(member, []).append(point)
        return outcome

    def find(members: Sequence[Member], point: int) -> None:
        rejection = tried(members, [point]).rejection
        if rejection is None:
            return
        if len(members) == 1:
            rejected.add(members[0])
            report(members[0], rejection)
        else:
            for some in _halves(members):
                find(some, point)

    members, left = list(points), list(order)
    while left := [point for point in left if any(point in points[m] for m in members)]:
        outcome = tried(members, left)
        if outcome.rejection is None:
            break
        point = left[0] if outcome.at is None else outcome.at
        find([m for m in members if point in points[m]], point)
        members = [m for m in members if m not in rejected]
        left = left[left.index(point) + 1 :]
    for some in _halves([member for member in hidden if member not in rejected]):
        own = {member: hidden[member] for member in some}
        rejected |= rejected_members(attempt, own, order, report)
    return rejected


def _halves(members: Sequence[Member]) -> list[Sequence[Member]]:
    half = (len(members) + 1) // 2
    return [some for some in (members[:half], members[half:]) if some]
