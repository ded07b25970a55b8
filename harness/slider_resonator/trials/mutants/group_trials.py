"""Clear many variants of an FMU at once, and find those among them that are rejected.

Most variants that pass the first scenes pass all. So several are put into one FMU. Where it passes,
each has passed whose changed statement was executed; where it is rejected, halves are tried, down
to one: a rejection is always that of one variant alone. Variants whose statements others kept from
being executed are tried again with fewer.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Generic, TypeVar

from slider_resonator.trials.mutants.trial import Rejection

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
    attempt: Try[Member], points: Mapping[Member, Sequence[int]], order: Sequence[int]
) -> dict[Member, Rejection]:
    """Return the members that are rejected at one of their `points`, tried in the given order."""
    rejected: dict[Member, Rejection] = {}
    hidden: dict[Member, list[int]] = {}

    def at(point: int) -> list[Member]:
        return [m for m in points if m not in rejected and point in points[m]]

    def note(outcome: Outcome[Member], tried: Sequence[Member]) -> None:
        for point, took_part in outcome.passed.items():
            for member in tried if len(tried) > 1 else ():
                if point in points[member] and member not in took_part:
                    hidden.setdefault(member, []).append(point)

    def find(members: Sequence[Member], point: int, rejection: Rejection) -> None:
        if len(members) == 1:
            rejected[members[0]] = rejection
            return
        half = len(members) // 2
        for some in (members[:half], members[half:]):
            outcome = attempt(some, [point])
            note(outcome, some)
            if outcome.rejection is not None:
                find(some, point, outcome.rejection)

    left = [point for point in order if at(point)]
    while left:
        members = [m for m in points if m not in rejected]
        outcome = attempt(members, left)
        note(outcome, members)
        if outcome.rejection is None:
            break
        point = left[0] if outcome.at is None else outcome.at
        find(at(point), point, outcome.rejection)
        left = [later for later in left[left.index(point) + 1 :] if at(later)]
    waiting = [member for member in hidden if member not in rejected]
    half = (len(waiting) + 1) // 2
    for some in filter(None, (waiting[:half], waiting[half:])):
        rejected |= rejected_members(attempt, {m: hidden[m] for m in some}, order)
    return rejected
