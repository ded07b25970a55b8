"""The table of a sweep: Parquet or CSV, the same bytes for the same rows.

A journal beside it keeps the finished points until it is written.
"""

import csv
from collections.abc import Iterable, Mapping, Sequence
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from slider_resonator.errors import HarnessError
from slider_resonator.output.files import replacing, writable, write_csv
from slider_resonator.sweeping.measures import Row, Task

SUFFIXES = (".parquet", ".csv")
REMEDY = "must be a new file, or allow it to be overwritten (--overwrite, overwrite=True)"

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


def table_columns(task: Task, points: Sequence[tuple[float, ...]], rows: Iterable[Row]) -> Columns:
    """Return the columns of the table that these rows make, some or all of the points."""
    lines = ((number, *points[number], *cells, error) for number, cells, error in rows)
    columns = zip(task.columns, zip(*lines, strict=True), strict=True)
    return {name: [*map(int, one)] if kind is int else [*one] for (name, kind), one in columns}


def replaceable(path: Path, task: Task, points: Sequence[tuple[float, ...]]) -> Columns:
    """Return the columns of the table that a file is, none where there is no file.

    Raises HarnessError for a file that is no table of these points, or has other measures.
    """
    if not path.exists():
        return {}
    try:
        columns = _read(path)
        found = [[float(value) for value in columns[name]] for name in ("point", *task.names)]
    except (OSError, ValueError, LookupError, TypeError, NotImplementedError, csv.Error):
        found = []
    if not found or list(zip(*found, strict=True)) != [
        (float(number), *point) for number, point in enumerate(points)
    ]:
        raise HarnessError(f"{path}: is not a table of this grid's points; {REMEDY}")
    lost = [name for name in columns if name not in dict(task.columns)]
    if lost:
        raise HarnessError(
            f"{path}: has columns that this grid does not measure: {', '.join(lost)}; {REMEDY}"
        )
    return columns


def _read(path: Path) -> Columns:
    if path.suffix.lower() != ".csv":
        from pyarrow import parquet

        return dict(parquet.read_table(path).to_pydict())
    with path.open(encoding="utf-8", newline="") as file:
        names, *rows = csv.reader(file, strict=True)
    return dict(zip(names, map(list, zip(*rows, strict=True)), strict=True))


def check_nothing_lost(path: Path, before: Columns, now: Columns) -> None:
    """Raise HarnessError where the table at `path`, of columns `before`, has other results.

    `now` are some rows of the table to be. They can be of another device: a table does not tell.
    """
    is_text = path.suffix.lower() == ".csv"
    for name in [name for name in now if name in before and name != "error"]:
        for point, value in zip(now["point"], now[name], strict=True):
            old, new = before[name][point], str(value) if is_text else value
            if old not in (None, "", new):
                raise HarnessError(
                    f"{path}: has {name} = {old} at point {point}, now {new}, of another device, "
                    f"FMU or version; {REMEDY}"
                )


def write_table(path: Path, task: Task, columns: Columns) -> None:
    """Write the table; the suffix chooses the format. Numbers come back to the last digit."""
    if path.suffix.lower() == ".csv":
        write_csv(path, columns, zip(*columns.values(), strict=True))
        return
    import pyarrow as pa
    from pyarrow import parquet

    types = {int: pa.int64(), float: pa.float64(), str: pa.string()}
    schema = pa.schema([(name, types[kind]) for name, kind in task.columns])
    with replacing(path) as temporary:
        parquet.write_table(pa.table(dict(columns), schema=schema), temporary)


def journal_path(table: Path) -> Path:
    """Return where the journal of a table is."""
    return table.with_name(f"{table.name}.journal")
