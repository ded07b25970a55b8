"""Read measurements from columns with headings: of CSV files, or of arrays."""

from collections.abc import Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from math import nan
from pathlib import Path
from typing import Any

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.device.interface import ALL_OUTPUTS, HELD, INPUTS, PARAMETERS, VARIABLES
from slider_resonator.device.schedule import Schedule
from slider_resonator.device.signal import through
from slider_resonator.device.units import is_number, scaled
from slider_resonator.errors import HarnessError, explained, unknown_name
from slider_resonator.fitting.measurements import STEADY, TIME, Measurements, Point, Run
from slider_resonator.scenes.csv_signal import csv_number, csv_rows, split_heading
from slider_resonator.scenes.device_file import IN_ANOTHER_UNIT

_ALIASES = {"frequency": "drive_frequency", "amplitude": "base_amplitude"}
_STEADY_ALIASES = {
    "velocity": "steady_velocity",
    "mean_velocity": "steady_velocity",
    "force": "blocking_force",
}
"""Other names of what a table measures; those of a run are the outputs themselves."""
_ROW_NUMBERS = ("", "#", "index", "no", "nr", "point")
"""Headings of columns that only number the rows, without a dot and in small letters."""
MAX_ROWS = 100_000


@dataclass(frozen=True)
class _Headings:
    """Names that columns can have, those of them that can be measured, and other words for them."""

    names: Sequence[str]
    outputs: Sequence[str]
    aliases: Mapping[str, str]

    @classmethod
    def among(cls, headings: Iterable[str]) -> "_Headings":
        """Return those of a run where a heading says `time`, else those of a table."""
        run = cls([*INPUTS, *HELD, *ALL_OUTPUTS, "time"], [*ALL_OUTPUTS], _ALIASES)
        if any(run.parts(heading)[0] == "time" for heading in headings):
            return run
        return cls([*INPUTS, *PARAMETERS, *STEADY, "time"], STEADY, _ALIASES | _STEADY_ALIASES)

    def parts(self, heading: str) -> tuple[str, str, str]:
        """Return name, std and unit of a heading; the last two are empty if it lacks them."""
        name, unit = split_heading(heading)
        words = "_".join(name.lower().split())
        name = words.removesuffix("_std")
        return self.aliases.get(name, name), words.removeprefix(name), unit

    def meaning(self, heading: str) -> tuple[str, str, float]:
        """Return name, unit and factor to the SI unit; ValueError for a wrong heading."""
        name, std, unit = self.parts(heading)
        if name not in self.names or (std and name not in self.outputs):
            if meant := self._with_brackets(heading):
                raise ValueError(f"unknown column {heading!r}; write {meant!r}")
            said = unknown_name("column", name + std, {*self.names, *self.aliases})
            raise ValueError(f"{said}; take out a column of numbers that the fit is not to use")
        with explained(f"heading {heading!r}: ", ValueError):
            return name + ("_std" if std else ""), unit, _factor(name, unit)

    def _with_brackets(self, heading: str) -> str | None:
        """Return `velocity [mm/s]` for the heading velocity_mm_s and the like, None for others."""
        words = heading.split("_")
        for count in range(1, len(words)):
            name, unit = "_".join(words[:count]), "/".join(words[count:])
            known = self.parts(name)[0]
            with suppress(ValueError):
                if known in self.names and _factor(known, unit):
                    return f"{name} [{unit}]"
        return None


def _factor(name: str, unit: str) -> float:
    """Return the factor from a unit, or none, to the SI unit; ValueError for a wrong one."""
    return VARIABLES[TIME if name == "time" else name].in_si(f"1 {unit}") if unit else 1.0


def read_measurements(path: Path) -> Measurements:
    """Read a CSV file: a run if it has a column `time`, else a table of steady measurements.

    A heading is a name, a name and a unit in brackets, such as `phase [deg]`, or a measured name
    with `_std`, its standard deviation. Columns of text with other headings are ignored, and noted.
    Raises HarnessError with file, line, value and requirement.
    """
    try:
        header, filled = csv_rows(path)
        if not 1 <= len(filled) <= MAX_ROWS:
            raise ValueError(f"{len(filled)} rows below the header; must be 1 to {MAX_ROWS}")
        rows = [f"line {line}" for line, _ in filled]
        columns = [
            (heading, [row[index] if index < len(row) else "" for _, row in filled])
            for index, heading in enumerate(header)
        ]
        return _measurements(str(path), rows, columns)
    except ValueError as error:
        said = str(error)
        raise HarnessError(said if str(path) in said else f"{path}: {said}") from error


def measurements_of(data: Any, source: str = "data") -> Measurements:
    """Return measurements as they are, or of a file, a DataFrame, columns by heading, or several.

    Raises HarnessError as `read_measurements` and `measurements_from` do.
    """
    if isinstance(data, Measurements):
        return data
    if isinstance(data, str | Path):
        return read_measurements(Path(data))
    if hasattr(data, "to_dict"):
        data = data.to_dict("list")
    if isinstance(data, Mapping):
        return measurements_from(data, source)
    if not isinstance(data, Iterable):
        raise HarnessError(f"{source} = {data!r}: must be a file, columns, or several of these")
    parts = (measurements_of(one, f"data {number}") for number, one in enumerate(data, 1))
    return sum(parts, Measurements())


def measurements_from(table: Mapping[str, Any], source: str = "data") -> Measurements:
    """Return measurements from columns of numbers by heading, as `read_measurements` has them.

    NaN and None are empty cells. Columns of text with other headings are ignored, and noted.
    Raises HarnessError with row, heading and requirement.
    """
    try:
        columns = [
            (heading, ["" if cell is None else str(cell) for cell in values])
            for heading, values in table.items()
        ]
        lengths = {len(cells) for _, cells in columns}
        if len(lengths) != 1:
            raise ValueError("must be columns of one length")
        rows = [f"row {number}" for number in range(1, lengths.pop() + 1)]
        return _measurements(source, rows, columns)
    except (ValueError, TypeError) as error:
        raise HarnessError(f"{source}: {error}") from error


def _measurements(
    source: str, rows: Sequence[str], columns: Sequence[tuple[str, Sequence[str]]]
) -> Measurements:
    """Return measurements from cells by heading; ValueError for a wrong heading or cell.

    Columns that number the rows or have no numbers are ignored, and noted.
    """
    headings = _Headings.among(heading for heading, _ in columns)
    values: dict[str, Array] = {}
    units: dict[str, tuple[str, float]] = {}
    ignored = []
    for heading, cells in columns:
        counts = headings.parts(heading)[0] in headings.names or any(map(is_number, cells))
        if not counts or heading.lower().rstrip(".") in _ROW_NUMBERS:
            ignored += [heading] if counts or heading else []
            continue
        column = _numbers(heading, rows, cells)
        name, unit, factor = headings.meaning(heading)
        if name in values:
            raise ValueError(f"two columns {name}; must be one")
        values[name] = np.array([scaled(number, factor) for number in column.tolist()])
        if unit:
            units[name] = (unit, factor)
    for name in values:
        deviations = values.get(f"{name}_std", np.ones(len(rows)))
        for index in np.flatnonzero(np.isfinite(values[name]) & ~(deviations > 0.0)).tolist():
            said = f"{name}_std = {deviations[index]:g}: must be above 0"
            raise HarnessError(f"{source} {rows[index]}: {said}")
    found = (_run if "time" in values else _table)(source, rows, values)
    plain = [
        (source, name, value)
        for name in IN_ANOTHER_UNIT
        if name in values and name not in units
        for value in dict.fromkeys(values[name].tolist())
    ]
    note = f"{source}: ignored {', '.join(map(repr, ignored))}: no numbers, or row numbers"
    notes = (*([note] if ignored else []), *found.notes)
    return replace(found, units=units, plain_numbers=tuple(plain), notes=notes)


def _numbers(heading: str, rows: Sequence[str], cells: Sequence[str]) -> Array:
    """Return the numbers of cells, NaN of empty ones; ValueError with row, heading and text."""
    found = np.full(len(cells), np.nan)
    for index, (row, cell) in enumerate(zip(rows, cells, strict=True)):
        if cell.strip().lower() not in ("", "nan"):
            try:
                found[index] = csv_number(heading, cells, index)
            except ValueError as error:
                raise ValueError(f"{row}: {error}, or empty") from error
    return found


def _check_filled(source: str, rows: Sequence[str], name: str, column: Array) -> None:
    """Raise HarnessError for an empty cell of a column, in the row of that name."""
    for index in np.flatnonzero(~np.isfinite(column)).tolist():
        raise HarnessError(f"{source} {rows[index]}: {name} is empty; must be a number")


def _table(source: str, rows: Sequence[str], values: Mapping[str, Array]) -> Measurements:
    """Return steady measurements from columns by name in SI units, (n,) each, with n rows."""
    measured = [name for name in STEADY if name in values]
    if not measured:
        raise HarnessError(f"{source}: measures nothing; must have a column {' or '.join(STEADY)}")
    given = [n for n in values if n.removesuffix("_std") not in STEADY]
    there = np.isfinite([values[name] for name in measured])
    is_needed = np.array(there.any(axis=0))
    for name in given:
        _check_filled(source, rows, name, np.where(is_needed, values[name], 0.0))
    points = []
    for index, row in enumerate(rows):
        own = {name: float(values[name][index]) for name in given}
        for name in [name for name, known in zip(measured, there[:, index], strict=True) if known]:
            deviation = float(values[f"{name}_std"][index]) if f"{name}_std" in values else nan
            points.append(Point(own, name, float(values[name][index]), deviation, source, row))
    skipped = np.count_nonzero(~is_needed)
    note = f"{source}: {skipped} of {len(rows)} rows skipped: nothing measured"
    return Measurements(tuple(points), notes=(note,) if skipped else ())


def _run(source: str, rows: Sequence[str], values: Mapping[str, Array]) -> Measurements:
    """Return a run from such columns."""
    times = values["time"]
    settable = [name for name in (*INPUTS, *HELD) if name in values]
    for name in ("time", *settable):
        _check_filled(source, rows, name, values[name])
    for index in (np.flatnonzero(np.diff(times) <= 0.0) + 1).tolist():
        raise HarnessError(
            f"{source} {rows[index]}: time = {times[index]:.9g} s: must be above the "
            f"{times[index - 1]:.9g} s of the row before"
        )
    if times[0] < 0.0:
        raise HarnessError(
            f"{source} {rows[0]}: time = {times[0]:.9g} s: must be at least 0, when drive and "
            "device start; leave out the rows before the drive is switched on, or shift all times"
        )
    signals = {
        name: through(list(zip(times.tolist(), values[name].tolist(), strict=True)))
        for name in settable
    }
    inputs = {name: signal for name, signal in signals.items() if name in INPUTS}
    tuning = {name: signal for name, signal in signals.items() if name in HELD}
    outputs = {name: column for name, column in values.items() if name in ALL_OUTPUTS}
    if not outputs:
        raise HarnessError(f"{source}: measures nothing; must have a column of an output")
    deviations = {name: values[f"{name}_std"] for name in outputs if f"{name}_std" in values}
    notes = []
    if times[0] > 0.0:
        # A point at time 0 at which nothing is measured.
        times, rows = np.concatenate([[0.0], times]), ["", *rows]
        outputs, deviations = (
            {name: np.concatenate([[np.nan], column]) for name, column in some.items()}
            for some in (outputs, deviations)
        )
        notes.append(
            f"{source}: begins at {VARIABLES[TIME].shown(times[1])}; the device starts at time 0 "
            "in its initial state, at drive phase 0, and has the inputs of the first row until then"
        )
    schedule = Schedule(times, inputs, tuning=tuning)
    return Measurements(
        runs=(Run(source, schedule, outputs, deviations, rows),), notes=tuple(notes)
    )
