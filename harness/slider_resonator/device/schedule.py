"""Inputs over time, and the communication points at which an FMU gets them."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import KW_ONLY, dataclass, field, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from slider_resonator.arrays import Array
from slider_resonator.device.held_inputs import HeldInputs, TunedInputs
from slider_resonator.device.interface import INPUT_STARTS

GRID_TOLERANCE = 1e-9
"""A jump closer to a communication point than this fraction of the step moves that point."""

MAX_STEPS = 3_000_000
"""Communication steps that a run may have: an hour of table 1 in steps of a drive period has two
million, and all outputs are kept in memory."""


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
        if len(self.times) != len(self.values):
            raise ValueError(
                f"a signal needs as many values as times: {len(self.times)} times, "
                f"{len(self.values)} values"
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

    def over(self, times: Array) -> Array:
        """Return the values at ascending times (s), shape (n,), each as `at` gives it."""
        points, values = np.asarray(self.times), np.asarray(self.values)
        index = np.searchsorted(points, times, side="right") - 1
        before = values[np.maximum(index, 0)]
        if self.hold or len(points) == 1:
            return before
        left = np.clip(index, 0, len(points) - 2)
        inside = np.clip(times, points[0], points[-1])
        share = (inside - points[left]) / (points[left + 1] - points[left])
        between = values[left] + share * (values[left + 1] - values[left])
        return np.where((index < 0) | (index == len(points) - 1), before, between)

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


def steps(points: Sequence[tuple[float, float]]) -> Signal:
    """Return a signal held at each (time, value) until the next."""
    return Signal(tuple(t for t, _ in points), tuple(v for _, v in points))


def ramp(points: Sequence[tuple[float, float]]) -> Signal:
    """Return the polyline through the (time, value) points."""
    return Signal(tuple(t for t, _ in points), tuple(v for _, v in points), hold=False)


Steps = float | Sequence[float]
"""Size of the communication steps in s, or several sizes that follow each other over and over."""


def communication_points(stop: float, step: Steps, jumps: Iterable[float] = ()) -> Array:
    """Return the times 0, step, 2 step, ..., stop (s) together with the jumps inside, shape (n,).

    A grid point next to a jump is replaced by it, so that no step starts just
    before a jump and holds the old value throughout. Raises ValueError as `step_count` does.
    """
    sizes = [step] if isinstance(step, float | int) else list(step)
    grid = sizes[0] * np.arange(step_count(stop, step), dtype=np.float64)
    if len(sizes) > 1:
        grid = np.cumsum([0.0, *sizes * (len(grid) // len(sizes))])
    inside = {time for time in jumps if 0.0 < time < stop}
    fixed = np.array(sorted({0.0, stop} | inside))
    return _merged(grid[grid < stop], fixed, GRID_TOLERANCE * min(sizes))


def step_count(stop: float, step: Steps) -> int:
    """Return the number of steps of size `step` (s) up to `stop` (s); the last may be shorter.

    Several sizes are taken in turn. Raises ValueError for times that are not positive and for more
    than `MAX_STEPS` steps.
    """
    if not isinstance(step, float | int):
        if not min(step) > 0.0:
            raise ValueError(f"steps of {min(step)!r} s: must be positive")
        return len(step) * step_count(stop, float(sum(step)))
    if not (stop > 0.0 and step > 0.0):
        raise ValueError(f"a stop time of {stop!r} s in steps of {step!r} s: both must be positive")
    ratio = stop / step * (1.0 - GRID_TOLERANCE)
    if not ratio <= MAX_STEPS:
        raise ValueError(
            f"a stop time of {stop:.6g} s in steps of {step:.6g} s makes {ratio:.3g} communication "
            f"steps; must be at most {MAX_STEPS}"
        )
    return int(np.ceil(ratio))


def _merged(grid: Array, fixed: Array, distance: float) -> Array:
    """Return the sorted `fixed` points and those of the grid that are farther from all of them."""
    far = np.abs(grid - fixed[nearest(fixed, grid)]) > distance
    return np.union1d(grid[far], fixed)


def nearest(points: Array, targets: Array) -> NDArray[np.intp]:
    """Return the index of the nearest of the ascending points (n,) to each target (m,)."""
    after = np.searchsorted(points, targets).clip(max=len(points) - 1)
    before = (after - 1).clip(min=0)
    nearer = np.abs(points[before] - targets) < np.abs(points[after] - targets)
    return np.where(nearer, before, after)


@dataclass(frozen=True)
class Schedule:
    """The three inputs and the communication points (s), shape (n,), starting at 0.

    Inputs are sampled at each communication point and held until the next, and so is the `tuning`
    of tunable parameters, by name. `start_time` (s) is what the FMU gets as time 0. With
    `reads_twice` outputs are read where values change, both before and after they are set.

    With `interpolates` inputs are straight lines between the communication points, and the FMU gets
    their derivatives; tuning is held all the same.
    """

    times: Array
    phase: Signal = field(default_factory=lambda: constant(INPUT_STARTS["phase"]))
    load: Signal = field(default_factory=lambda: constant(INPUT_STARTS["load"]))
    frequency_ratio: Signal = field(
        default_factory=lambda: constant(INPUT_STARTS["frequency_ratio"])
    )

    _: KW_ONLY
    tuning: Mapping[str, Signal] = field(default_factory=dict)
    start_time: float = 0.0
    reads_twice: bool = False
    interpolates: bool = False

    @property
    def _signals(self) -> tuple[Signal, Signal, Signal]:
        return self.phase, self.load, self.frequency_ratio

    def sampled(self) -> Array:
        """Return phase (rad), load (N), frequency ratio at each communication point, (n, 3)."""
        return np.column_stack([signal.over(self.times) for signal in self._signals])

    def rates(self) -> Array:
        """Return the derivatives of the inputs from each communication point on, (n, 3); per s.

        Those of inputs that are held, and at the last point, are 0.
        """
        sampled, rates = self.sampled(), np.zeros((len(self.times), 3))
        if self.interpolates:
            ramped = [not signal.hold and len(signal.times) > 1 for signal in self._signals]
            slopes = np.diff(sampled, axis=0) / np.diff(self.times)[:, None]
            rates[:-1] = np.where(ramped, slopes, 0.0)
        return rates

    @property
    def ramps(self) -> bool:
        """Whether an input has a derivative anywhere."""
        return bool(self.rates().any())

    def tuned(self) -> Array:
        """Return the parameters of `tuning` at each communication point, (n, k)."""
        columns = [signal.over(self.times) for signal in self.tuning.values()]
        return np.array(columns, dtype=np.float64).reshape(-1, len(self.times)).T

    def changes(self) -> NDArray[np.intp]:
        """Return the indices of the points after the first at which a value changes, (m,).

        Nothing is set at the last point.
        """
        values = np.column_stack([self.sampled(), self.rates(), self.tuned()])[:-1]
        return np.flatnonzero(np.any(values[1:] != values[:-1], axis=1)) + 1

    def readings(self) -> Array:
        """Return the times (s) at which outputs are read, (r,): the communication points.

        With `reads_twice` one that a change follows comes twice, the second time one rounding
        later: a reference at that time is under the new values.
        """
        if not self.reads_twice:
            return self.times
        after = np.nextafter(self.times[self.changes()], np.inf)
        return np.sort(np.concatenate([self.times, after]))

    def refined(self, begin: float, step: float) -> Schedule:
        """Return the same held inputs with more points from `begin` (s) on.

        They are `step` (s) apart, give or take a hundredth of it beside a point of this
        schedule: those all stay, to the last digit.
        """
        begin, stop = max(0.0, begin), float(self.times[-1])
        fine = np.linspace(begin, stop, step_count(stop - begin, step) + 1)
        return self.read_at(fine, 0.01 * step)

    def read_at(self, times: Array, distance: float) -> Schedule:
        """Return the same held inputs with more points, at `times` (s), shape (m,).

        Those within `distance` (s) of a point of this schedule are left out.
        """
        return replace(
            self,
            times=_merged(times, self.times, distance),
            phase=self._as_held(self.phase),
            load=self._as_held(self.load),
            frequency_ratio=self._as_held(self.frequency_ratio),
            tuning={name: self._as_held(signal) for name, signal in self.tuning.items()},
        )

    def _as_held(self, signal: Signal) -> Signal:
        """Return a signal as it is held between the points of this schedule."""
        if len(signal.times) == 1:
            return signal
        held = signal.hold or not self.interpolates
        return Signal(tuple(self.times.tolist()), tuple(signal.over(self.times).tolist()), held)

    def held(self) -> list[HeldInputs]:
        """Return the inputs as the FMU sees them, equal neighbours merged into one interval."""
        sampled, tuned = np.column_stack([self.sampled(), self.rates()]), self.tuned()
        changes = self.changes().tolist()
        starts = [0, *changes]
        stops = [*changes, len(sampled) - 1]
        held = [
            HeldInputs(float(self.times[i]), float(self.times[j]), *map(float, sampled[i]))
            for i, j in zip(starts, stops, strict=True)
        ]
        if not self.tuning:
            return held
        names = tuple(self.tuning)
        return [
            TunedInputs(**vars(inputs), tuned=tuple(zip(names, tuned[i].tolist(), strict=True)))
            for inputs, i in zip(held, starts, strict=True)
        ]


def schedule(
    stop: float,
    step: Steps,
    tuning: Mapping[str, Signal] | None = None,
    interpolates: bool = False,
    /,
    **signals: Signal,
) -> Schedule:
    """Return the schedule over [0, stop] (s) with a step (s) and all jumps as points.

    `signals` are the inputs by name, `tuning` the tunable parameters that change. A schedule that
    `interpolates` has the corners of inputs as points, too.
    """
    tuning = tuning or {}
    points = [time for signal in (*signals.values(), *tuning.values()) for time in signal.jumps]
    if interpolates:
        points += [time for signal in signals.values() for time in signal.times]
    times = communication_points(stop, step, points)
    return Schedule(times, *in_order(signals), tuning=tuning, interpolates=interpolates)


def in_order(signals: Mapping[str, Signal]) -> tuple[Signal, Signal, Signal]:
    """Return phase, load and frequency ratio; those left out keep their start.

    Raises ValueError for another name.
    """
    unknown = signals.keys() - INPUT_STARTS.keys()
    if unknown:
        raise ValueError(f"inputs {', '.join(sorted(unknown))}: must be {', '.join(INPUT_STARTS)}")
    phase, load, ratio = (
        signals.get(name) or constant(start) for name, start in INPUT_STARTS.items()
    )
    return phase, load, ratio
