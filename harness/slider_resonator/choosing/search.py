"""Find the coarsest step or tolerance that meets the need, given its convergence rate."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from math import ceil, floor, isfinite, log

STALLED = 0.7
"""A refinement that leaves more than this share of the error does not converge."""
PATIENCE = 2
"""Refinements that must stall: the coarsest can be outside the range of convergence."""


def coarsest(
    excess: Callable[[int], float], count: int, gain: float, first: int = 0, fine: int = 0
) -> int | None:
    """Return the smallest index below `count` with `excess(index)` <= 1, None where none has.

    `excess` is error over allowed error, expected to fall by `gain` from each index to the next:
    that predicts the next index, and the value there decides. Starts at `first`; gives up where
    the error does not fall, but not above index `fine`: coarser ones may miss what happens.
    """
    known: dict[int, float] = {}
    index = first
    while True:
        known[index] = excess(index)
        good = min((i for i, value in known.items() if value <= 1.0), default=count)
        bad = max((i for i, value in known.items() if value > 1.0 and i < good), default=-1)
        if good == bad + 1:
            return good if good < count else None
        if good == count and _stalled(known):
            if max(known) >= fine:
                return None
            index = fine
            continue
        shift = _shift(known[index], gain, count)
        index = min(max(index + shift, bad + 1), good - 1)


def _shift(excess: float, gain: float, count: int) -> int:
    if not isfinite(excess):
        return max(1, count // 3)
    if excess <= 1.0:
        return -max(1, floor(-log(max(excess, 1e-300)) / log(gain)))
    return max(1, ceil(log(excess) / log(gain)))


def _stalled(known: dict[int, float]) -> bool:
    """Whether the error no longer falls at the finest indices evaluated."""
    last = [known[index] for index in sorted(known)[-PATIENCE - 1 :]]
    falls = [isfinite(fine) and fine > STALLED * coarse for coarse, fine in pairwise(last)]
    return len(falls) == PATIENCE and all(falls)
