"""What is found wrong with the conduct of an FMU."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from slider_resonator.arrays import Array

SHOWN = 3
"""Findings that a text names; the others are counted."""


@dataclass(frozen=True)
class Findings:
    """How many things are wrong, and the first of them in words."""

    count: int
    shown: tuple[str, ...]

    @classmethod
    def of(cls, faults: Sequence[str]) -> Findings:
        """Return the findings of faults in words."""
        return cls(len(faults), tuple(faults[:SHOWN]))

    def __add__(self, other: Findings) -> Findings:
        return Findings(self.count + other.count, (*self.shown, *other.shown)[:SHOWN])

    @property
    def text(self) -> str:
        """The first findings in words, and the number of the others."""
        more = self.count - len(self.shown)
        return "; ".join([*self.shown, *([f"and {more} more"] if more else [])])


NOTHING = Findings(0, ())


def differences(
    what: str,
    outputs: Sequence[str],
    times: Array,
    rows: Sequence[Sequence[float]],
    expected: Sequence[Sequence[float]],
) -> Findings:
    """Return where rows of outputs, at times (s) of shape (n,), are not equal to the last bit.

    `what` begins each finding. Rows that are missing or too many count as one difference each.
    """
    count = min(len(rows), len(expected))
    seen, right = np.array(rows[:count]), np.array(expected[:count])
    shape = count, len(outputs)
    places = np.argwhere(seen.reshape(shape) != right.reshape(shape))
    shown = [
        f"{what}: {outputs[column]} at {times[row]:.9g} s is {float(seen[row, column])!r}, was "
        f"{float(right[row, column])!r}"
        for row, column in places[:SHOWN].tolist()
    ]
    lengths = abs(len(rows) - len(expected))
    if lengths:
        shown.append(f"{what}: {len(rows)} readings, expected {len(expected)}")
    return Findings(len(places) + lengths, tuple(shown[:SHOWN]))
