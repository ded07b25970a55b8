"""Read measurements from columns with headings: of CSV files, or of arrays."""

from collections.abc import Iterable, Mapping, Sequence
from math import nan
from pathlib import Path
from typing import Any

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.device.interface import ALL_OUTPUTS, HELD, INPUTS, PARAMETERS
from slider_resonator.device.schedule import Schedule
from slider_resonator.device.signal import Signal
from slider_resonator.device.units import finite_number, is_number, scaled
from slider_resonator.errors import HarnessError, explained, unknown_name
from slider_resonator.fitting.measurements import STEADY, Measurements, Point, variable
from slider_resonator.scenes.csv_signal import csv_rows, heading_factor, split_heading
from slider_resonator.scenes.device_file import IN_ANOTHER_UNIT

_ALIASES = {"frequency": "drive_frequency", "amplitude": "base_amplitude"}
_STEADY_ALIASES = {
    **_ALIASES,
    "velocity": "steady_velocity",
    "mean_velocity": "steady_velocity",
    "force": "blocking_force",
}
"""Other names of what a table has; in a run `velocity` is the output itself."""
_ROW_NUMBERS = ("", "#", "index", "no", "nr", "point")
"""Headings of columns that only number the rows, without a dot and in small letters."""
MAX_ROWS = 100_000

Columns = Mapping[str, Array]
"""Numbers in SI units by name, shape (n,) each; NaN is an empty cell."""


def read_measurements(path: Path) -> Measurements:
    """Read a CSV file: a run if it has a column `time`, else a table of steady measurements.

    A heading is a name, a name and a unit in brackets, such as `phase [deg]`, or a measured name
    with `_std`, its standard deviation. Columns of text with other headings are ignored, and noted.
    Raises HarnessError with file, line, value and requirement.
    """
    with explained(kind=HarnessError):
        header, filled = csv_rows(path)
    with explained(f"{path}: ", HarnessError):
        if not 1 <= len(filled) <= MAX_ROWS:
            raise ValueError(f"{len(filled)} rows below the header; must be 1 to {MAX_ROWS}")
        columns = [
            (heading, [row[index] if index < len(row) else "" for _, row in filled])
            for index, heading in enumerate(header)
        ]
        return _measurements(str(path), [f"line {line}" for line, _ in filled], columns)


def measurements_of(data: Any, source: str = "data") -> Measurements:
    """Return measurements as they are, or of a file, a DataFrame, columns by heading, or several.

    Files and columns are as `read_measurements` has them; in columns, NaN and None are empty cells.
    Raises HarnessError with source, row, heading and requirement.
    """
    if isinstance(data, Measurements):
        return data
    if isinstance(data, str | Path):
        return read_measurements(Path(data))
    if hasattr(data, "to_dict"):
        data = data.to_dict("list")
    if not isinstance(data, Iterable):
        raise HarnessError(f"{source} = {data!r}: must be a file, columns, or several of these")
    if not isinstance(data, Mapping):
        parts = (measurements_of(one, f"{source} {number}") for number, one in enumerate(data, 1))
        return sum(parts, Measurements())
    try:
        columns = [
            (heading, ["" if cell is None else str(cell) for cell in values])
            for heading, values in data.items()
        ]
        lengths = {len(cells) for _, cells in columns}
        if len(lengths) != 1:
            raise ValueError("must be columns of one length")
        rows = [f"row {number}" for number in range(1, lengths.pop() + 1)]
        return _measurements(source, rows, columns)
    except (ValueError, TypeError) as error:
        raise HarnessError(f"{source}: {error}") from error


def _parts(heading: str, aliases: Mapping[str, str]) -> tuple[str, str]:
    """Return the name of a variable and "_std" for its standard deviations, else ""."""
    words = "_".join(split_heading(heading)[0].lower().split())
    name = words.removesuffix("_std")
    return aliases.get(name, name), words.removeprefix(name)


def _measurements(
    source: str, rows: Sequence[str], columns: Sequence[tuple[str, Sequence[str]]]
) -> Measurements:
    """Return measurements from cells by heading; ValueError for a wrong heading or cell.

    Columns that number the rows or have no numbers are ignored, and noted.
    """
    is_run = any(_parts(heading, _ALIASES)[0] == "time" for heading, _ in columns)
    aliases, outputs = (_ALIASES, [*ALL_OUTPUTS]) if is_run else (_STEADY_ALIASES, [*STEADY])
    settable = [*INPUTS, *(HELD if is_run else PARAMETERS), "time"]
    names = [*settable, *outputs]
    values: dict[str, Array] = {}
    plain_numbers: list[tuple[str, str, float]] = []
    ignored = []
    for heading, cells in columns:
        what, std = _parts(heading, aliases)
        counts = what in names or any(map(is_number, cells))
        if not counts or heading.lower().rstrip(".") in _ROW_NUMBERS:
            ignored += [heading] if counts or heading else []
            continue
        name = what + std
        if what not in (outputs if std else names):
            raise ValueError(
                f"{unknown_name('column', name, {*names, *aliases})}; a unit must be in brackets, "
                "such as 'phase [deg]'; take out a column of numbers that the fit is not to use"
            )
        if name in values:
            raise ValueError(f"two columns {name}; must be one")
        with explained("heading ", ValueError):
            factor = heading_factor(heading, variable(what).unit)
        values[name] = _numbers(heading, rows, cells, factor)
        if name in IN_ANOTHER_UNIT and not split_heading(heading)[1]:
            plain_numbers += [(source, name, value) for value in np.unique(values[name]).tolist()]
    measured = {name: column for name, column in values.items() if name in outputs}
    if not measured:
        raise ValueError(f"measures nothing; must have a column such as {outputs[0]}")
    given = {name: column for name, column in values.items() if name in settable}
    is_measured = np.isfinite([*measured.values()]).any(axis=0)
    for name, column in given.items():
        for index in np.flatnonzero((is_measured | is_run) & ~np.isfinite(column)).tolist():
            raise ValueError(f"{rows[index]}: {name} is empty; must be a number")
    schedule = _schedule(rows, given) if is_run else None
    settings = {"time": given["time"]} if is_run else given
    points = _points(source, rows, values, measured, settings)
    notes = []
    if ignored:
        notes.append(f"ignored {', '.join(map(repr, ignored))}: no numbers, or row numbers")
    if schedule is None and not is_measured.all():
        skipped = np.count_nonzero(~is_measured)
        notes.append(f"{skipped} of {len(rows)} rows skipped: nothing measured")
    if schedule is not None and len(schedule.times) > len(rows):
        notes.append(
            f"begins at {variable('time').shown(schedule.times[1])}; the device starts at time 0 "
            "in its initial state, at drive phase 0, and has the inputs of the first row until then"
        )
    return Measurements(
        points,
        {} if schedule is None else {source: schedule},
        plain_numbers=tuple(plain_numbers),
        notes=tuple(f"{source}: {note}" for note in notes),
    )


def _numbers(heading: str, rows: Sequence[str], cells: Sequence[str], factor: float) -> Array:
    """Return the numbers of cells in the SI unit, NaN of empty ones.

    Raises ValueError with row, heading and text.
    """
    found = np.full(len(cells), np.nan)
    for index, cell in enumerate(map(str.strip, cells)):
        if cell.lower() not in ("", "nan"):
            try:
                found[index] = scaled(finite_number(heading, cell), factor)
            except ValueError as error:
                raise ValueError(f"{rows[index]}: {error}, or empty") from error
    return found


def _points(
    source: str, rows: Sequence[str], values: Columns, measured: Columns, settings: Columns
) -> tuple[Point, ...]:
    """Return what is measured under the settings of each row.

    Raises ValueError for a standard deviation that is not above 0.
    """
    given = {name: column.tolist() for name, column in settings.items()}
    points = []
    for name, column in measured.items():
        deviations = values.get(f"{name}_std")
        for index in np.flatnonzero(np.isfinite(column)).tolist():
            deviation = nan if deviations is None else float(deviations[index])
            if deviations is not None and not deviation > 0.0:
                raise ValueError(f"{rows[index]}: {name}_std = {deviation:g}: must be above 0")
            own = {setting: numbers[index] for setting, numbers in given.items()}
            number = float(column[index])
            points.append(Point(own, name, number, deviation, source, rows[index]))
    return tuple(points)


def _schedule(rows: Sequence[str], given: Columns) -> Schedule:
    """Return a run from time 0 on under inputs and parameters that are `given` over time."""
    times = given["time"]
    for index in (np.flatnonzero(np.diff(times) <= 0.0) + 1).tolist():
        raise ValueError(
            f"{rows[index]}: time = {times[index]:.9g} s: must be above the "
            f"{times[index - 1]:.9g} s of the row before"
        )
    if times[0] < 0.0:
        raise ValueError(
            f"{rows[0]}: time = {times[0]:.9g} s: must be at least 0, when drive and device start; "
            "leave out the rows before the drive is switched on, or shift all times"
        )
    inputs, tuning = (
        {
            name: Signal(tuple(times.tolist()), tuple(given[name].tolist()))
            for name in names
            if name in given
        }
        for names in (INPUTS, HELD)
    )
    return Schedule(np.union1d([0.0], times), inputs, tuning=tuning)
