from __future__ import annotations

import csv
from pathlib import Path

import pytest
from pyarrow import parquet

from slider_resonator.errors import HarnessError
from slider_resonator.sweeping import table
from slider_resonator.sweeping.measures import Row, Run, Task
from slider_resonator.sweeping.table import check_writer, table_columns, write_table

TASK = Task(("fidelity", "phase"), (), ("steady_velocity",), 20, Run(1, 1, 0))
POINTS = ((0.0, 0.1), (2.0, 0.1 + 0.2))
ROWS: dict[int, Row] = {1: (1, [1.0 / 3.0, "steady"], None), 0: (0, [None, None], 'load, "x"')}


def test_parquet_has_typed_columns_in_the_order_of_the_points(tmp_path: Path) -> None:
    path = tmp_path / "a.parquet"
    columns = table_columns(TASK, POINTS, ROWS)
    write_table(path, TASK, columns)
    read = parquet.read_table(path)
    assert read.to_pydict() == columns
    assert [str(kind) for kind in read.schema.types] == [
        "int64",
        "int64",
        "double",
        "double",
        "string",
        "string",
    ]


def test_csv_gives_back_the_same_numbers(tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    write_table(path, TASK, table_columns(TASK, POINTS, ROWS))
    with path.open(encoding="utf-8", newline="") as file:
        first, second = csv.DictReader(file)
    assert first["error"] == 'load, "x"'
    assert first["steady_velocity"] == ""
    assert second["fidelity"] == "2"
    assert float(second["phase"]) == 0.1 + 0.2
    assert float(second["steady_velocity"]) == 1.0 / 3.0


def test_without_pyarrow_only_csv_is_possible(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(table, "find_spec", lambda name: None)
    check_writer(Path("a.csv"))
    with pytest.raises(HarnessError, match=r"pip install 'slider-resonator\[parquet\]'"):
        check_writer(Path("a.parquet"))
