"""Measurements of a device: steady velocities and blocking forces, and runs over time."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from math import isfinite
from pathlib import Path
from typing import Any

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.device.interface import HELD, INPUTS, PARAMETERS, VARIABLES
from slider_resonator.device.schedule import Schedule, in_order
from slider_resonator.device.signal import steps
from slider_resonator.device.values import si_value
from slider_resonator.errors import HarnessError, unknown_name
from slider_resonator.scenes.csv_signal import check_cells, csv_number, csv_rows

STEADY = ("steady_velocity", "blocking_force")
"""What can be measured without a run, by the outputs of the FMU."""
_ALIASES = {
    "frequency": "drive_frequency",
    "amplitude": "base_amplitude",
    "velocity": "steady_velocity",
    "mean_velocity": "steady_velocity",
    "force": "blocking_force",
}
"""Other names of the columns of a table; those of a run are the outputs themselves."""
_HEADING = re.compile(r"\s*(?P<name>\w+?)(?P<std>_std)?\s*(?:[\[(](?P<unit>[^\])]*)[\])])?\s*")
MAX_ROWS = 100_000
TIME = "last_event_time"
"""A variable with the unit of a column `time`."""


@dataclass(frozen=True)
class Point:
    """A steady `quantity` measured under `values`; both in SI units.

    `deviation` is the standard deviation of the measurement, None where it is not known.
    """

    values: Mapping[str, float]
    quantity: str
    measured: float
    deviation: float | None = None


@dataclass(frozen=True)
class Run:
    """Outputs at the communication points of a schedule, each of shape (n,), NaN where unknown."""

    source: str
    schedule: Schedule
    outputs: Mapping[str, Array]
    deviations: Mapping[str, Array] = field(default_factory=dict)


@dataclass(frozen=True)
class Measurements:
    """All that is measured. Numbers come in the order of points, then runs, output by output."""

    points: tuple[Point, ...] = ()
    runs: tuple[Run, ...] = ()

    @property
    def measured(self) -> Array:
        """What was measured, shape (n,), without what a run leaves out."""
        runs = [column[np.isfinite(column)] for run in self.runs for column in run.outputs.values()]
        return np.concatenate([[point.measured for point in self.points], *runs])

    @property
    def quantities(self) -> list[str]:
        """The quantity of each number, length n."""
        names = [point.quantity for point in self.points]
        for run in self.runs:
            for name, column in run.outputs.items():
                names += [name] * int(np.isfinite(column).sum())
        return names

    @property
    def deviations(self) -> Array:
        """Standard deviations, shape (n,), NaN where they are not known."""
        points = [np.nan if p.deviation is None else p.deviation for p in self.points]
        runs = [
            run.deviations.get(name, np.full(len(column), np.nan))[np.isfinite(column)]
            for run in self.runs
            for name, column in run.outputs.items()
        ]
        return np.concatenate([points, *runs])

    @property
    def knows_deviations(self) -> bool:
        """Whether the numbers have their standard deviations; HarnessError if only some have."""
        known = np.isfinite(self.deviations)
        if known.any() and not known.all():
            raise HarnessError(
                f"{np.count_nonzero(known)} of {len(known)} numbers have a standard deviation; "
                "must be all or none"
            )
        return bool(known.all())

    @property
    def sizes(self) -> Array:
        """Root mean square of the quantity of each number, shape (n,)."""
        measured, quantities = self.measured, np.array(self.quantities)
        sizes = np.empty(len(measured))
        for name in set(self.quantities):
            own = quantities == name
            sizes[own] = np.sqrt(np.mean(measured[own] ** 2)) or 1.0
        return sizes

    @property
    def scales(self) -> Array:
        """Standard deviations, shape (n,), or what stands for them up to a common factor.

        Without any, the numbers of one quantity err alike, and by the same share of their root mean
        square as those of another.
        """
        return self.deviations if self.knows_deviations else self.sizes

    def under(self, inputs: Mapping[str, float]) -> Measurements:
        """Return the same with inputs of the points that do not say them."""
        points = (replace(point, values={**inputs, **point.values}) for point in self.points)
        return Measurements(tuple(points), self.runs)

    def __add__(self, other: Measurements) -> Measurements:
        """Return both together."""
        return Measurements(self.points + other.points, self.runs + other.runs)


def read_measurements(path: Path) -> Measurements:
    """Read a CSV file: a run if it has a column `time`, else a table of steady measurements.

    A heading is a name, a name and a unit in brackets, such as `phase [deg]`, or a measured name
    with `_std`, its standard deviation. Raises HarnessError with file, line, value and requirement.
    """
    return _measurements(path, _columns(path))


def measurements_from(table: Mapping[str, Any]) -> Measurements:
    """Return measurements from columns of numbers by heading, as `read_measurements` has them.

    NaN is an empty cell. Raises HarnessError with heading and requirement.
    """
    try:
        columns = [(heading, np.asarray(values, np.float64)) for heading, values in table.items()]
        shapes = {values.shape for _, values in columns}
        if len(shapes) != 1 or len(shapes.pop()) != 1:
            raise ValueError("must be columns of one length")
        named = _named(columns)
    except (ValueError, TypeError) as error:
        raise HarnessError(f"data: {error}") from error
    return _measurements(Path("data"), named)


def _measurements(source: Path, columns: Mapping[str, Array]) -> Measurements:
    return _run(source, columns) if "time" in columns else _table(source, columns)


def _columns(path: Path) -> dict[str, Array]:
    """Return the columns by name in SI units, empty cells as NaN."""
    try:
        header, lines = csv_rows(path)
        check_cells(path, header, lines)
        rows = [(line, row) for line, row in lines if any(cell.strip() for cell in row)]
        if not 1 <= len(rows) <= MAX_ROWS:
            raise ValueError(f"{path}: {len(rows)} rows below the header; must be 1 to {MAX_ROWS}")
        cells = (
            (heading, np.array([_cell(line, heading, row, index) for line, row in rows]))
            for index, heading in enumerate(header)
        )
        return _named(list(cells))
    except ValueError as error:
        said = str(error)
        raise HarnessError(said if str(path) in said else f"{path}: {said}") from error


def _named(columns: Sequence[tuple[str, Array]]) -> dict[str, Array]:
    """Return columns by name in SI units from those by heading; ValueError for a wrong heading."""
    is_run = any(_heading(heading)["name"] == "time" for heading, _ in columns)
    named: dict[str, Array] = {}
    for heading, values in columns:
        name, factor = _column(heading, is_run)
        if name in named:
            raise ValueError(f"two columns {name}; must be one")
        named[name] = factor * values
    return named


def _heading(heading: str) -> Mapping[str, str]:
    """Return name, std and unit of a heading; the last two are empty if it does not have them."""
    match = _HEADING.fullmatch(heading)
    return match.groupdict("") if match else {"name": heading, "std": "", "unit": ""}


def _column(heading: str, is_run: bool) -> tuple[str, float]:
    """Return the name that a heading stands for, and the factor to SI units.

    Raises ValueError with the heading and what it must be.
    """
    parts = _heading(heading)
    outputs = [name for name, one in VARIABLES.items() if one.causality == "output"]
    measured = outputs if is_run else [*STEADY]
    allowed = [*INPUTS, *(HELD if is_run else PARAMETERS), *measured, "time"]
    name = parts["name"] if is_run else _ALIASES.get(parts["name"], parts["name"])
    if name not in allowed or (parts["std"] and name not in measured):
        raise ValueError(unknown_name("column", name + parts["std"], allowed))
    try:
        of_unit = TIME if name == "time" else name
        factor = si_value(of_unit, f"1 {parts['unit']}") if parts["unit"] else 1.0
    except ValueError as error:
        raise ValueError(f"heading {heading!r}: {error}") from error
    return name + parts["std"], factor


def _cell(line: int, heading: str, row: Sequence[str], index: int) -> float:
    """Return the number of a cell, NaN of an empty one; ValueError with line, heading and text."""
    if index >= len(row) or not row[index].strip():
        return float("nan")
    try:
        return csv_number(heading, row, index)
    except ValueError as error:
        raise ValueError(f"line {line}: {error}, or empty") from error


def _table(path: Path, columns: Mapping[str, Array]) -> Measurements:
    measured = [name for name in STEADY if name in columns]
    if not measured:
        raise HarnessError(f"{path}: measures nothing; must have a column {' or '.join(STEADY)}")
    given = [n for n in columns if n.removesuffix("_std") not in STEADY]
    points = []
    for row in range(len(columns[measured[0]])):
        values = {name: float(columns[name][row]) for name in given}
        for name in [name for name, value in values.items() if not isfinite(value)]:
            raise HarnessError(f"{path} row {row + 1}: {name} is empty; must be a number")
        for name in measured:
            value = float(columns[name][row])
            if isfinite(value):
                deviation = _deviation(path, columns, name, row)
                points.append(Point(values, name, value, deviation))
    return Measurements(points=tuple(points))


def _deviation(path: Path, columns: Mapping[str, Array], name: str, row: int) -> float | None:
    if f"{name}_std" not in columns:
        return None
    deviation = float(columns[f"{name}_std"][row])
    if not deviation > 0.0:
        raise HarnessError(f"{path} row {row + 1}: {name}_std = {deviation:g}: must be above 0")
    return deviation


def _run(path: Path, columns: Mapping[str, Array]) -> Measurements:
    times = columns["time"] - columns["time"][0]
    if not np.all(np.diff(times) > 0.0):
        raise HarnessError(f"{path}: time must be in every row, and increase strictly")
    settable = (*INPUTS, *HELD)
    signals = {}
    for name in settable:
        if name in columns:
            if not np.all(np.isfinite(columns[name])):
                raise HarnessError(f"{path}: {name} is empty in a row; must be a number")
            signals[name] = steps(list(zip(times.tolist(), columns[name].tolist(), strict=True)))
    inputs = {name: signal for name, signal in signals.items() if name in INPUTS}
    tuning = {name: signal for name, signal in signals.items() if name in HELD}
    outputs = {n: c for n, c in columns.items() if n in VARIABLES and n not in settable}
    if not outputs:
        raise HarnessError(f"{path}: measures nothing; must have a column of an output")
    deviations = {name: columns[f"{name}_std"] for name in outputs if f"{name}_std" in columns}
    for name, column in deviations.items():
        if not np.all(column[np.isfinite(outputs[name])] > 0.0):
            raise HarnessError(f"{path}: {name}_std must be above 0 in every row")
    schedule = Schedule(times, *in_order(inputs), tuning=tuning)
    return Measurements(runs=(Run(str(path), schedule, outputs, deviations),))


def datasheet(
    velocity: float | None, blocking: float | None, loaded: Sequence[tuple[float, float]]
) -> Measurements:
    """Return the numbers of a datasheet: no-load velocity (m/s), blocking force (N), velocities.

    `loaded` are pairs of load (N) and velocity (m/s).
    """
    points = [Point({"load": load}, STEADY[0], speed) for load, speed in loaded]
    if velocity is not None:
        points.insert(0, Point({"load": 0.0}, STEADY[0], velocity))
    if blocking is not None:
        points.append(Point({}, STEADY[1], blocking))
    return Measurements(tuple(points))
