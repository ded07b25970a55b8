"""The table of a sweep: Parquet or CSV, the same bytes for the same rows."""

from __future__ import annotations

import csv
from collections.abc import Mapping, Sequence
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from slider_resonator.errors import HarnessError
from slider_resonator.output.atomic import replacing
from slider_resonator.output.targets import writable
from slider_resonator.sweeping.measures import Task
from slider_resonator.sweeping.worker import Row

SUFFIXES = (".parquet", ".csv")

Columns = Mapping[str, list[Any]]
"""Column name to its entries, one a point; None where there is none."""


def check_writer(path: Path) -> None:
    """Raise HarnessError where the table could not be written: its path, or a package it needs."""
    writable(str(path), SUFFIXES)
    if path.suffix.lower() == ".parquet" and find_spec("pyarrow") is None:
        raise HarnessError(
            f"{path}: Parquet needs pyarrow: pip install 'slider-resonator[parquet]'; "
            "a file called .csv does not"
        )


def table_columns(
    task: Task, points: Sequence[tuple[float, ...]], rows: Mapping[int, Row]
) -> Columns:
    """Return the columns of the table, ordered by the number of the point."""
    names = [name for name, _ in task.columns]
    kinds = [kind for _, kind in task.columns]
    lines = []
    for number, values in enumerate(points):
        _, cells, error = rows[number]
        line: list[Any] = [number, *values, *cells, error]
        lines.append([int(e) if kind is int else e for kind, e in zip(kinds, line, strict=True)])
    return dict(zip(names, map(list, zip(*lines, strict=True)), strict=True))


def holds_other_points(path: Path, task: Task, points: Sequence[tuple[float, ...]]) -> bool:
    """Whether a file is there that is not a table of these points."""
    if not path.exists():
        return False
    names = ["point", *task.names]
    try:
        found = (
            _read_csv(path, names) if path.suffix.lower() == ".csv" else _read_parquet(path, names)
        )
    except (OSError, ValueError, KeyError, csv.Error):
        return True
    return found != [(float(number), *point) for number, point in enumerate(points)]


def _read_csv(path: Path, names: Sequence[str]) -> list[tuple[float, ...]]:
    with path.open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file, strict=True))
    return [tuple(float(row[name]) for name in names) for row in rows]


def _read_parquet(path: Path, names: Sequence[str]) -> list[tuple[float, ...]]:
    from pyarrow import parquet

    columns = parquet.read_table(path, columns=list(names)).to_pydict()
    return [tuple(map(float, row)) for row in zip(*(columns[name] for name in names), strict=True)]


def write_table(path: Path, task: Task, columns: Columns) -> None:
    """Write the table; the suffix chooses the format. Numbers come back to the last digit."""
    with replacing(path) as temporary:
        if path.suffix.lower() == ".csv":
            _write_csv(temporary, columns)
        else:
            _write_parquet(temporary, task, columns)


def _write_csv(path: Path, columns: Columns) -> None:
    with path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows(zip(*columns.values(), strict=True))


def _write_parquet(path: Path, task: Task, columns: Columns) -> None:
    import pyarrow as pa
    from pyarrow import parquet

    types = {int: pa.int64(), float: pa.float64(), str: pa.string()}
    schema = pa.schema([(name, types[kind]) for name, kind in task.columns])
    parquet.write_table(pa.table(dict(columns), schema=schema), path)
