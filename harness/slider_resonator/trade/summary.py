"""The figures at the top: the cost of averaged motion, resolved motion and peers at an error."""

from __future__ import annotations

from dataclasses import dataclass

from slider_resonator.trade.result import (
    AVERAGED,
    PEER,
    RESOLVED,
    Row,
    Trade,
    cheapest,
    paired_ratio,
)

TARGETS = (("mean_velocity", 1e-2), ("position", 1e-9))
"""Quantity, and the error at which costs are compared."""
ROUNDS_UP = 0.9995
"""Share of a unit that three digits round to the whole unit."""
CLASSES = {AVERAGED: "averaged", RESOLVED: "resolved", PEER: "peers"}


@dataclass(frozen=True)
class Standing:
    """The cheapest method of a class at an error, None where none reaches it.

    `ratio` is its cost over that of the resolved one, repeat by repeat: median, minimum, maximum.
    """

    quantity: str
    error: float
    kind: str
    row: Row | None
    ratio: tuple[float, float, float] | None


def standings(trade: Trade) -> list[Standing]:
    """Return the standing of every class at every target."""
    found = []
    for quantity, error in TARGETS:
        rows = trade.candidates(quantity)
        against = cheapest([row for row in rows if row.kind == RESOLVED], quantity, error)
        for kind in CLASSES:
            row = cheapest([row for row in rows if row.kind == kind], quantity, error)
            ratio = None if row is None or against is None else paired_ratio(row, against)
            found.append(Standing(quantity, error, kind, row, ratio))
    return found


def sentence(standing: Standing) -> str:
    """Return a standing in words."""
    name = CLASSES[standing.kind]
    if standing.row is None:
        return f"{name}: not reached"
    row = standing.row
    words = f"{name}: {duration(row.cost)} a simulated second ({row.method})"
    if standing.ratio is None or standing.kind == RESOLVED:
        return words
    middle, low, high = standing.ratio
    if middle < 1.0:
        shares = f"{1.0 / middle:.3g} times cheaper than resolved"
        return f"{words}, {shares} ({1.0 / high:.3g} to {1.0 / low:.3g})"
    return f"{words}, {middle:.3g} times the cost of resolved ({low:.3g} to {high:.3g})"


def comparisons(trade: Trade) -> list[tuple[str, list[str]]]:
    """Return the standings in words: the target, and a sentence for each class."""
    by_target: dict[str, list[str]] = {}
    for standing in standings(trade):
        words = heading(standing.quantity, standing.error)
        by_target.setdefault(words, []).append(sentence(standing))
    return list(by_target.items())


def heading(quantity: str, error: float) -> str:
    """Return the target in words."""
    size = f"{100.0 * error:g} %" if error >= 1e-3 else f"{error:.0e}"
    return f"at an error of {size} in {quantity.replace('_', ' ')}"


def duration(seconds: float) -> str:
    """Return a CPU time in three digits, with a unit."""
    for unit, size in (("s", 1.0), ("ms", 1e-3), ("us", 1e-6)):
        if seconds >= ROUNDS_UP * size:
            return f"{seconds / size:.3g} {unit}"
    return f"{seconds / 1e-9:.3g} ns"
