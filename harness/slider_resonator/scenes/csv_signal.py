"""Read the points of an input from a CSV file."""

from __future__ import annotations

import csv
from pathlib import Path


def csv_points(path: Path, column: str) -> list[tuple[float, float]]:
    """Return (time, value) of a CSV file with the columns `time` and `column`, or `value`.

    Raises ValueError naming the file, the line and what is wrong.
    """
    try:
        with path.open(newline="", encoding="utf-8-sig") as file:
            rows = list(csv.reader(file))
    except OSError as error:
        raise ValueError(f"csv {path} cannot be read: {error.strerror}") from error
    header = [name.strip() for name in rows[0]] if rows else []
    if not header or header[0] != "time":
        raise ValueError(f"csv {path}: the first column must be 'time', the header is {header}")
    name = column if column in header else "value"
    if name not in header:
        raise ValueError(f"csv {path}: no column {column!r} or 'value', only {header[1:]}")
    index = header.index(name)
    points = []
    for line, row in enumerate(rows[1:], start=2):
        try:
            points.append((float(row[0]), float(row[index])))
        except (IndexError, ValueError) as error:
            raise ValueError(f"csv {path} line {line}: {row} has no number there") from error
    return points
