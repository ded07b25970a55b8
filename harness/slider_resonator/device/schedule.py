"""Communication points, and the inputs that an FMU gets at them."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import KW_ONLY, dataclass, field, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from slider_resonator.arrays import Array
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.device.interface import INPUT_STARTS
from slider_resonator.device.signal import GRID_TOLERANCE, Signal, constant

MAX_STEPS = 3_000_000
"""Communication steps that a run may have: an hour of table 1 in steps of a drive period has two
million, and all outputs are kept in memory."""


Steps = float | Sequence[float]
"""Size of the communication steps in s, or several sizes that follow each other over and over."""


def communication_points(stop: float, step: Steps, jumps: Iterable[float] = ()) -> Array:
    """Return the times 0, step, 2 step, ..., stop (s) together with the jumps inside, shape (n,).

    A grid point next to a jump is replaced by it, so that no step starts just
    before a jump and holds the old value throughout. Raises ValueError as `step_count` does.
    """
    sizes = np.atleast_1d(step)
    grid = sizes[0] * np.arange(step_count(stop, step), dtype=np.float64)
    if len(sizes) > 1:
        grid = np.cumsum([0.0, *np.tile(sizes, len(grid) // len(sizes))])
    inside = {time for time in jumps if 0.0 < time < stop}
    fixed = np.array(sorted({0.0, stop} | inside))
    return _merged(grid[grid < stop], fixed, GRID_TOLERANCE * min(sizes))


def step_count(stop: float, step: Steps) -> int:
    """Return the number of steps of size `step` (s) up to `stop` (s); the last may be shorter.

    Several sizes are taken in turn. Raises ValueError for times that are not positive and for more
    than `MAX_STEPS` steps.
    """
    sizes = np.atleast_1d(step)
    smallest = float(min(sizes))
    if not (stop > 0.0 and smallest > 0.0):
        raise ValueError(f"a stop time of {stop!r} s in steps of {smallest!r} s: must be above 0")
    count = len(sizes) * np.ceil(stop / float(sum(sizes)) * (1.0 - GRID_TOLERANCE))
    if not count <= MAX_STEPS:
        raise ValueError(
            f"a stop time of {stop:.6g} s in steps of {smallest:.6g} s makes {count:.3g} steps; "
            f"must be at most {MAX_STEPS}: take longer steps, or a shorter time"
        )
    return int(count)


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
    """The communication points (s), shape (n,), starting at 0, and the `signals` of inputs by name.

    Signals are of the first three inputs; those left out keep their start. Inputs are sampled at
    each communication point and held until the next, and so is the `tuning` of tunable parameters
    and deviations of the drive, by name. `start_time` (s) is what the FMU gets as time 0. With
    `reads_twice` outputs are read where values change, both before and after they are set.

    With `interpolates` inputs are straight lines between the communication points, and the FMU gets
    their derivatives; tuning is held all the same.

    The values at the communication points are computed once; nobody may write to their arrays.
    """

    times: Array
    signals: Mapping[str, Signal] = field(default_factory=dict)

    _: KW_ONLY
    tuning: Mapping[str, Signal] = field(default_factory=dict)
    start_time: float = 0.0
    reads_twice: bool = False
    interpolates: bool = False

    @property
    def _inputs(self) -> list[Signal]:
        return [self.signals.get(name, constant(start)) for name, start in INPUT_STARTS.items()]

    @cached_property
    def sampled(self) -> Array:
        """Phase (rad), load (N), frequency ratio at each communication point, (n, 3)."""
        return np.column_stack([signal.over(self.times) for signal in self._inputs])

    @cached_property
    def rates(self) -> Array:
        """Derivatives of the inputs from each communication point on, (n, 3); per s.

        Those of inputs that are held, and at the last point, are 0.
        """
        rates = np.zeros((len(self.times), 3))
        if self.interpolates:
            ramped = [not signal.hold and len(signal.times) > 1 for signal in self._inputs]
            slopes = np.diff(self.sampled, axis=0) / np.diff(self.times)[:, None]
            rates[:-1] = np.where(ramped, slopes, 0.0)
        return rates

    @property
    def ramps(self) -> bool:
        """Whether an input has a derivative anywhere."""
        return bool(self.rates.any())

    @cached_property
    def tuned(self) -> Array:
        """The parameters of `tuning` at each communication point, (n, k)."""
        columns = [signal.over(self.times) for signal in self.tuning.values()]
        return np.array(columns, dtype=np.float64).reshape(-1, len(self.times)).T

    @cached_property
    def changes(self) -> NDArray[np.intp]:
        """Indices of the points after the first at which a value changes, (m,).

        Nothing is set at the last point.
        """
        values = np.column_stack([self.sampled, self.rates, self.tuned])[:-1]
        return np.flatnonzero(np.any(values[1:] != values[:-1], axis=1)) + 1

    def readings(self) -> Array:
        """Return the times (s) at which outputs are read, (r,): the communication points.

        With `reads_twice` one that a change follows comes twice, the second time one rounding
        later: a reference at that time is under the new values.
        """
        if not self.reads_twice:
            return self.times
        after = np.nextafter(self.times[self.changes], np.inf)
        return np.sort(np.concatenate([self.times, after]))

    def read_at(self, times: Array, distance: float) -> "Schedule":
        """Return the same held inputs with more points, at `times` (s), shape (m,).

        Those within `distance` (s) of a point of this schedule are left out; all of these stay.
        """
        signals = {
            name: self._sampled(signal, hold=signal.hold or not self.interpolates)
            for name, signal in self.signals.items()
        }
        times = _merged(times, self.times, distance)
        return replace(self, times=times, signals=signals, tuning=self.held_tuning)

    @property
    def held_tuning(self) -> dict[str, Signal]:
        """The `tuning` as it is held between the points of this schedule."""
        return {name: self._sampled(signal, hold=True) for name, signal in self.tuning.items()}

    def _sampled(self, signal: Signal, *, hold: bool) -> Signal:
        if len(signal.times) == 1:
            return signal
        return Signal(tuple(self.times.tolist()), tuple(signal.over(self.times).tolist()), hold)

    def held(self) -> list[HeldInputs]:
        """Return the inputs as the FMU sees them, equal neighbours merged into one interval."""
        sampled, tuned = np.column_stack([self.sampled, self.rates]), self.tuned
        changes = self.changes.tolist()
        return [
            HeldInputs(
                *(float(self.times[i]), float(self.times[j]), *map(float, sampled[i])),
                tuned=tuple(zip(self.tuning, tuned[i].tolist(), strict=True)),
            )
            for i, j in zip([0, *changes], [*changes, len(sampled) - 1], strict=True)
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
    return Schedule(times, signals, tuning=tuning, interpolates=interpolates)
