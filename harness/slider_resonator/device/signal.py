"""An input over time."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from slider_resonator.arrays import Array

GRID_TOLERANCE = 1e-9
"""A jump closer to a communication point than this fraction of the step moves that point."""


@dataclass(frozen=True)
class Signal:
    """An input over time, given by points: held from each point to the next, or a polyline.

    `times` (s) increase strictly. Before the first and after the last point the value is constant.
    `file` is the one that the points were read from: a run that goes beyond them is refused.
    """

    times: tuple[float, ...]
    values: tuple[float, ...]
    hold: bool = True
    file: Path | None = None

    def __post_init__(self) -> None:
        if not self.times:
            raise ValueError("a signal needs at least one point")
        if not np.all(np.isfinite([*self.times, *self.values])):
            raise ValueError("a signal needs finite times and values")
        for before, after in zip(self.times, self.times[1:], strict=False):
            if not after > before:
                raise ValueError(f"times must increase strictly: {after!r} s follows {before!r} s")

    def at(self, time: float) -> float:
        """Return the value at `time` (s); at a jump, the value after it."""
        return float(self.over(np.array([time]))[0])

    def over(self, times: Array) -> Array:
        """Return the values at times (s), shape (n,), each as `at` gives it."""
        if not self.hold:
            return np.interp(times, self.times, self.values)
        index = np.searchsorted(self.times, times, side="right") - 1
        return np.array(self.values, dtype=np.float64)[np.maximum(index, 0)]

    def check_covers(self, stop: float) -> None:
        """Raise ValueError where a file has no values from 0 to `stop` (s), but for rounding."""
        slack = GRID_TOLERANCE * stop
        first, last = self.times[0], self.times[-1]
        if self.file is not None and (first > slack or last < stop - slack):
            raise ValueError(
                f"csv {self.file}: has values from {first:.9g} s to {last:.9g} s, "
                f"must have them from 0 s to {stop:.9g} s, the end of the run"
            )

    @property
    def jumps(self) -> tuple[float, ...]:
        """Times (s) at which the value jumps."""
        return self.times[1:] if self.hold else ()


def constant(value: float) -> Signal:
    """Return a signal that never changes."""
    return Signal((0.0,), (value,))


def through(points: Sequence[tuple[float, float]], *, hold: bool = True) -> Signal:
    """Return the signal through (time, value) points: held from each to the next, or a polyline."""
    return Signal(tuple(t for t, _ in points), tuple(v for _, v in points), hold)
