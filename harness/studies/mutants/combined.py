"""Several mutants of Python modules in one FMU, which notes what it executes of them."""

from __future__ import annotations

import threading
from collections.abc import Sequence
from functools import cache

from studies.mutants.mutant import Mutant
from studies.mutants.reach import noting_source

_PARSING = threading.Lock()
"""Threads of Python 3.11 that parse at once may end in SystemError (python/cpython#106905)."""


def groups_of(mutants: Sequence[Mutant], size: int) -> list[list[Mutant]]:
    """Return the mutants in groups of at most `size`, in which no two change one statement."""
    groups: list[dict[tuple[str, int], Mutant]] = []
    for mutant in mutants:
        place = (mutant.file, mutant.statement or mutant.line)
        fitting = (group for group in groups if len(group) < size and place not in group)
        group = next(fitting, None)
        if group is None:
            groups.append({place: mutant})
        else:
            group[place] = mutant
    return [list(group.values()) for group in groups]


def combined_sources(mutants: Sequence[Mutant]) -> dict[str, bytes]:
    """Return the noting source of each module that the mutants change, by path in the FMU.

    No two of them may change one statement. Lines keep their numbers.
    """
    sources = {}
    for path in {mutant.path for mutant in mutants}:
        here = [mutant for mutant in mutants if mutant.path == path]
        text = here[0].old
        for begin, end, new in sorted(map(_edit, here), reverse=True):
            text = f"{text[:begin]}{new}{text[end:]}"
        with _PARSING:
            sources[path] = noting_source(text).encode()
    return sources


@cache
def _edit(mutant: Mutant) -> tuple[int, int, str]:
    """Return begin and end of what a mutant replaces, and its text with as many lines."""
    old, new = mutant.old, mutant.new
    begin = _common(old, new)
    end = min(_common(old[::-1], new[::-1]), len(old) - begin, len(new) - begin)
    replaced, text = old[begin : len(old) - end], new[begin : len(new) - end]
    return begin, len(old) - end, text + "\n" * (replaced.count("\n") - text.count("\n"))


def _common(one: str, other: str) -> int:
    """Return how many characters two texts begin with in common."""
    pairs = enumerate(zip(one, other, strict=False))
    return next((i for i, (a, b) in pairs if a != b), min(len(one), len(other)))
