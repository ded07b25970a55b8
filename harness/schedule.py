"""Inputs over time, and the communication points at which an FMU gets them."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from harness.interface import INPUT_STARTS
from harness.references.held_inputs import HeldInputs

GRID_TOLERANCE = 1e-9
"""A jump closer to a communication point than this fraction of the step moves that point."""


@dataclass(frozen=True)
class Signal:
    """An input over time, given by points: held from each point to the next, or a polyline.

    `times` (s) increase strictly. Before the first and after the last point the value is theirs.
    """

    times: tuple[float, ...]
    values: tuple[float, ...]
    hold: bool = True

    def __post_init__(self) -> None:
        if not self.times or len(self.times) != len(self.values):
            raise ValueError(
                f"a signal needs as many values as times and at least one: "
                f"{len(self.times)} times, {len(self.values)} values"
            )
        if not np.all(np.isfinite([*self.times, *self.values])):
            raise ValueError("a signal needs finite times and values")
        for before, after in zip(self.times, self.times[1:], strict=False):
            if not after > before:
                raise ValueError(f"times must increase strictly: {after!r} s follows {before!r} s")

    def at(self, time: float) -> float:
        """Return the value at `time` (s); at a jump, the value after it."""
        index = bisect_right(self.times, time) - 1
        if index < 0:
            return self.values[0]
        if self.hold or index == len(self.times) - 1:
            return self.values[index]
        left, right = self.times[index], self.times[index + 1]
        share = (time - left) / (right - left)
        return self.values[index] + share * (self.values[index + 1] - self.values[index])

    @property
    def jumps(self) -> tuple[float, ...]:
        """Times (s) at which the value jumps."""
        return self.times[1:] if self.hold else ()


def constant(value: float) -> Signal:
    """Return a signal that never changes."""
    return Signal((0.0,), (value,))


def steps(points: Sequence[tuple[float, float]]) -> Signal:
    """Return a signal held at each (time, value) until the next."""
    return Signal(tuple(t for t, _ in points), tuple(v for _, v in points))


def ramp(points: Sequence[tuple[float, float]]) -> Signal:
    """Return the polyline through the (time, value) points."""
    return Signal(tuple(t for t, _ in points), tuple(v for _, v in points), hold=False)


def communication_points(
    stop: float, step: float, jumps: Iterable[float] = ()
) -> NDArray[np.float64]:
    """Return the times 0, step, 2 step, ..., stop (s) together with the jumps inside, shape (n,).

    A grid point that all but coincides with a jump is replaced by it, so that no step starts just
    before a jump and holds the old value throughout.
    """
    if not (stop > 0.0 and step > 0.0):
        raise ValueError(f"stop = {stop!r} s and step = {step!r} s must be positive")
    count = int(np.ceil(stop / step * (1.0 - GRID_TOLERANCE)))
    grid = np.append(step * np.arange(count), stop)
    inside = np.array(sorted({t for t in jumps if 0.0 < t < stop}), dtype=np.float64)
    if inside.size == 0:
        return grid
    nearest = np.abs(grid[:, None] - inside[None, :]).min(axis=1)
    kept = grid[(nearest > GRID_TOLERANCE * step) | (grid == 0.0) | (grid == stop)]
    return np.union1d(kept, inside)


@dataclass(frozen=True)
class Schedule:
    """The three inputs and the communication points (s), shape (n,), starting at 0.

    Inputs are sampled at each communication point and held until the next.
    """

    times: NDArray[np.float64]
    phase: Signal = field(default_factory=lambda: constant(INPUT_STARTS["phase"]))
    load: Signal = field(default_factory=lambda: constant(INPUT_STARTS["load"]))
    frequency_ratio: Signal = field(
        default_factory=lambda: constant(INPUT_STARTS["frequency_ratio"])
    )

    def sampled(self) -> NDArray[np.float64]:
        """Return phase (rad), load (N), frequency ratio at each communication point, (n, 3)."""
        signals = (self.phase, self.load, self.frequency_ratio)
        return np.array([[s.at(float(t)) for s in signals] for t in self.times])

    def held(self) -> list[HeldInputs]:
        """Return the inputs as the FMU sees them, equal neighbours merged into one interval."""
        sampled = self.sampled()[:-1]
        changes = np.flatnonzero(np.any(sampled[1:] != sampled[:-1], axis=1)) + 1
        starts = [0, *changes.tolist()]
        stops = [*changes.tolist(), len(sampled)]
        return [
            HeldInputs(float(self.times[i]), float(self.times[j]), *map(float, sampled[i]))
            for i, j in zip(starts, stops, strict=True)
        ]


def schedule(
    stop: float,
    step: float,
    *,
    phase: Signal | None = None,
    load: Signal | None = None,
    frequency_ratio: Signal | None = None,
) -> Schedule:
    """Return the schedule over [0, stop] (s) with a step (s) and all jumps as points."""
    given = {"phase": phase, "load": load, "frequency_ratio": frequency_ratio}
    signals = {name: signal for name, signal in given.items() if signal is not None}
    jumps = [time for signal in signals.values() for time in signal.jumps]
    return Schedule(communication_points(stop, step, jumps), **signals)
