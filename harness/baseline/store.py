"""The CSV files of a scene's golden results."""

from __future__ import annotations

import csv
import shutil
import tempfile
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from harness.baseline.golden import SIGNALS, Golden, order, unit
from harness.baseline.provenance import Provenance
from harness.compare import Measurement, Value
from harness.errors import HarnessError

NUMBERS, TRAJECTORY, PROVENANCE = "numbers.csv", "trajectory.csv", "provenance.csv"
DIGITS = 13
"""Significant digits in the files: what differs beyond them hangs on the platform's sine."""
NONE = "none"
"""Written for a quantity that does not exist there, such as the velocity of a slow beat."""

At = tuple[tuple[str, float], ...]
"""What a sweep has varied, () without a sweep."""


@dataclass(frozen=True)
class Recorded:
    """Golden results at every point of a scene's sweep, and where they come from."""

    points: Mapping[At, Golden]
    provenance: Provenance


def key(at: Mapping[str, float]) -> At:
    """Return the point of a sweep as a key."""
    return tuple(sorted(at.items()))


def write_recorded(folder: Path, recorded: Recorded) -> None:
    """Write the files of a scene, in place of those that are there, all of them or none.

    Raises HarnessError when the folder cannot be written.
    """
    try:
        folder.parent.mkdir(parents=True, exist_ok=True)
        fresh = Path(tempfile.mkdtemp(prefix=f".{folder.name}-", dir=folder.parent))
        try:
            _write(fresh / NUMBERS, ["at", "quantity", "unit", "value"], _number_rows(recorded))
            if any(name in SIGNALS for golden in recorded.points.values() for name in golden):
                _write(fresh / TRAJECTORY, ["at", "time", *SIGNALS], _signal_rows(recorded))
            _write(fresh / PROVENANCE, ["what", "value"], recorded.provenance.items())
            fresh.chmod(0o755)
            replace_folder(fresh, folder)
        finally:
            shutil.rmtree(fresh, ignore_errors=True)
    except OSError as error:
        raise HarnessError(f"{folder}: cannot be written: {error.strerror or error}") from error


def replace_folder(fresh: Path, folder: Path) -> None:
    """Put one folder in the place of another, which there need not be; OSError when it cannot."""
    if folder.exists():
        with tempfile.TemporaryDirectory(prefix=f".{folder.name}-", dir=folder.parent) as old:
            folder.rename(Path(old) / folder.name)
            fresh.rename(folder)
    else:
        fresh.rename(folder)


def read_recorded(folder: Path) -> Recorded:
    """Read the files of a scene; HarnessError names the file and the line that is no record."""
    points: dict[At, dict[str, Measurement]] = {}
    for place, name, _, value in _read(folder / NUMBERS, 4):
        points.setdefault(_at(place), {})[name] = Measurement(_value(value))
    columns: dict[At, list[list[str]]] = {}
    if (folder / TRAJECTORY).exists():
        for place, *row in _read(folder / TRAJECTORY, 2 + len(SIGNALS)):
            columns.setdefault(_at(place), []).append(row)
    for at, rows in columns.items():
        table = np.array(rows, dtype=np.float64).T
        signals = {
            name: Measurement(column, times=table[0])
            for name, column in zip(SIGNALS, table[1:], strict=True)
        }
        points.setdefault(at, {}).update(signals)
    return Recorded(points, {what: value for what, value in _read(folder / PROVENANCE, 2)})


def recorded_scenes(folder: Path) -> list[Path]:
    """Return the folders of the scenes that are recorded, in alphabetical order."""
    found = [path.parent for path in folder.glob(f"*/{PROVENANCE}")]
    return sorted(path for path in found if not path.name.startswith("."))


def _number_rows(recorded: Recorded) -> Iterable[Sequence[str]]:
    for at, golden in recorded.points.items():
        for name in sorted(golden, key=order):
            if name not in SIGNALS:
                yield _place(at), name, unit(name), _text(golden[name].value)


def _signal_rows(recorded: Recorded) -> Iterable[Sequence[str]]:
    for at, golden in recorded.points.items():
        signals = [golden[name] for name in SIGNALS if name in golden]
        if signals:
            columns = [signals[0].times, *(signal.value for signal in signals)]
            for row in zip(*columns, strict=True):
                yield _place(at), *(_text(float(number)) for number in row)


def _write(path: Path, header: Sequence[str], rows: Iterable[Sequence[str]]) -> None:
    with path.open("w", newline="", encoding="utf-8") as file:
        csv.writer(file, lineterminator="\n").writerows([header, *rows])


def _read(path: Path, width: int) -> list[list[str]]:
    try:
        with path.open(newline="", encoding="utf-8") as file:
            rows = list(csv.reader(file))[1:]
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise HarnessError(f"{path}: cannot be read: {error}") from error
    for line, row in enumerate(rows, start=2):
        if len(row) != width:
            raise HarnessError(f"{path} line {line}: {len(row)} cells; allowed are {width}")
    return rows


def _text(value: Value) -> str:
    if value is None:
        return NONE
    return value if isinstance(value, str) else f"{value + 0.0:.{DIGITS}g}"  # no minus zero


def _value(text: str) -> Value:
    if text == NONE:
        return None
    try:
        return float(text)
    except ValueError:
        return text


def _place(at: At) -> str:
    return " ".join(f"{name}={value!r}" for name, value in at)


def _at(text: str) -> At:
    pairs = (part.partition("=") for part in text.split())
    return tuple((name, float(value)) for name, _, value in pairs)
