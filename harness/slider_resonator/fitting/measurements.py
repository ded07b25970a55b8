"""Measurements of a device: steady velocities and blocking forces on curves, runs over time."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from math import nan

import numpy as np
from numpy.typing import NDArray

from slider_resonator.arrays import Array
from slider_resonator.device.device import DEVIATIONS
from slider_resonator.device.interface import VARIABLES
from slider_resonator.device.schedule import Schedule
from slider_resonator.device.signal import constant
from slider_resonator.device.variable import Variable
from slider_resonator.errors import HarnessError

STEADY = ("steady_velocity", "blocking_force")
"""What can be measured without a run, by the outputs of the FMU."""


@dataclass(frozen=True)
class Point:
    """A number: a steady `quantity` measured under `values`, or one of a run; all in SI units.

    `deviation` is the standard deviation of the measurement, NaN where it is not known. `source`
    and `row` are those of the file. Of a number of a run `values` has the `time` alone.
    """

    values: Mapping[str, float]
    quantity: str
    measured: float
    deviation: float = nan
    source: str = "datasheet"
    row: str = ""


@dataclass(frozen=True)
class Measurements:
    """All that is measured: `points`, and schedules of `runs` by their source.

    `noise` is what each number errs by without stated deviations, (n,) or one for all, in root mean
    squares of the quantity and up to a common factor. `plain_numbers` are source, name and value of
    frequencies and phases without a unit. `notes` say what was done in reading.
    """

    points: tuple[Point, ...] = ()
    runs: Mapping[str, Schedule] = field(default_factory=dict)
    noise: Array | float = 1.0
    plain_numbers: tuple[tuple[str, str, float], ...] = ()
    notes: tuple[str, ...] = ()

    @property
    def steady(self) -> list[Point]:
        """The points that are not of a run."""
        return [one for one in self.points if "time" not in one.values]

    @property
    def measured(self) -> Array:
        """What was measured, shape (n,)."""
        return np.array([one.measured for one in self.points])

    @property
    def deviations(self) -> Array:
        """Standard deviations, shape (n,), NaN where they are not known."""
        return np.array([one.deviation for one in self.points])

    @property
    def quantities(self) -> NDArray[np.str_]:
        """The quantity of each number, shape (n,)."""
        return np.array([one.quantity for one in self.points], np.str_)

    @property
    def knows_deviations(self) -> bool:
        """Whether the numbers have their standard deviations; HarnessError if only some have."""
        known = np.isfinite(self.deviations)
        if known.any() and not known.all():
            one = self.points[int(np.argmin(known))]
            raise HarnessError(
                f"{np.count_nonzero(known)} of {len(known)} numbers have a standard deviation; "
                f"must be all or none: give {one.source} a column {one.quantity}_std, or take all "
                "such out"
            )
        return bool(known.all())

    @cached_property
    def times(self) -> Array:
        """The time of each number in its run (s), shape (n,), NaN for steady ones."""
        return np.array([one.values.get("time", nan) for one in self.points])

    @cached_property
    def series(self) -> dict[tuple[str, str], NDArray[np.intp]]:
        """The indices of the numbers of each quantity and source."""
        found: dict[tuple[str, str], list[int]] = {}
        for index, one in enumerate(self.points):
            found.setdefault((one.quantity, one.source), []).append(index)
        return {name: np.array(rows) for name, rows in found.items()}

    @property
    def sizes(self) -> Array:
        """Root mean square of the quantity of each number, shape (n,)."""
        _, own = np.unique(self.quantities, return_inverse=True)
        squares = np.bincount(own, self.measured**2) / np.bincount(own)
        return np.where(squares > 0.0, np.sqrt(squares), 1.0)[own]

    @property
    def scales(self) -> Array:
        """Standard deviations, shape (n,), or what stands for them up to a common factor."""
        if self.knows_deviations:
            return self.deviations
        return self.sizes * self.noise

    def root_mean_squares(self, values: Array) -> list[tuple[str, float]]:
        """Return those of `values` (n,), without NaN, over the numbers of each quantity by name."""
        found = []
        for quantity in dict.fromkeys(self.quantities.tolist()):
            own = values[(self.quantities == quantity) & np.isfinite(values)]
            if own.size:
                found.append((quantity, float(np.sqrt(np.mean(own**2)))))
        return found

    @property
    def given(self) -> list[tuple[str, set[str]]]:
        """The source of each steady point and run, and the names of what is set there."""
        given = [(one.source, {*one.values}) for one in self.steady]
        return given + [(name, {*one.signals, *one.tuning}) for name, one in self.runs.items()]

    def refuse_known(self, settings: Mapping[str, float]) -> None:
        """Raise HarnessError for a setting of no effect, as all data have values of their own."""
        for name, value in settings.items():
            if all(name in names for _, names in self.given):
                raise HarnessError(
                    f"{name} = {value:g}: {self.given[0][0]} has values of {name}; must be one of "
                    "the two"
                )

    def under(self, inputs: Mapping[str, float]) -> "Measurements":
        """Return the same with inputs of the steady points and runs that do not say them."""
        points = (
            one if "time" in one.values else replace(one, values={**inputs, **one.values})
            for one in self.points
        )
        held = {name: constant(value) for name, value in inputs.items()}
        tuning = {name: held.pop(name) for name in DEVIATIONS if name in held}
        runs = {
            source: replace(run, signals={**held, **run.signals}, tuning={**tuning, **run.tuning})
            for source, run in self.runs.items()
        }
        return replace(self, points=tuple(points), runs=runs)

    def __add__(self, other: "Measurements") -> "Measurements":
        """Return both together."""
        return Measurements(
            self.points + other.points,
            {**self.runs, **other.runs},
            plain_numbers=self.plain_numbers + other.plain_numbers,
            notes=self.notes + other.notes,
        )


def datasheet(
    velocity: float | None, blocking: float | None, loaded: Sequence[tuple[float, float]]
) -> Measurements:
    """Return the numbers of a datasheet: no-load velocity (m/s), blocking force (N), velocities.

    `loaded` are pairs of load (N) and velocity (m/s).
    """
    points = [
        Point({"load": load}, STEADY[0], speed, row=f"load {VARIABLES['load'].shown(load)}")
        for load, speed in loaded
    ]
    if velocity is not None:
        points.insert(0, Point({"load": 0.0}, STEADY[0], velocity, row="no load"))
    if blocking is not None:
        points.append(Point({}, STEADY[1], blocking, row="no motion"))
    return Measurements(tuple(points))


def variable(name: str) -> Variable:
    """Return the variable that a column sets or measures; `time` is one like `last_event_time`."""
    return VARIABLES["last_event_time" if name == "time" else name]


def shown(quantity: str, value: float) -> str:
    """Return a measured value (SI) in the unit that engineers state it in, in three digits."""
    return VARIABLES[quantity].shown(float(f"{value:.3g}"))


def set_value(point: Point, name: str) -> float:
    """Return what a variable was set to, in SI units."""
    return point.values.get(name, variable(name).start or 0.0)


def abscissa_and_curves(points: Sequence[Point]) -> tuple[str, dict[str, list[int]]]:
    """Return the variable with most values among the points, "" if none varies, and the curves.

    Points with the same values of all that varies beside it are a curve: their indices, by a name
    that has these values. It is empty for a single curve.
    """
    names = dict.fromkeys(name for point in points for name in point.values)
    counts = {name: len({set_value(point, name) for point in points}) for name in names}
    first, *others = sorted((n for n in names if counts[n] > 1), key=lambda n: -counts[n]) or [""]
    curves: dict[str, list[int]] = {}
    for i, point in enumerate(points):
        name = ", ".join(
            f"{other} {VARIABLES[other].shown(set_value(point, other))}" for other in others
        )
        curves.setdefault(name, []).append(i)
    return first, curves
