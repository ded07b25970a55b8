from __future__ import annotations

from pathlib import Path

import pytest

from slider_resonator.scenes.csv_signal import csv_points


def test_the_named_column_wins_over_value(tmp_path: Path) -> None:
    path = tmp_path / "in.csv"
    path.write_text("time, value, load\n0,1,2\n1,3,4\n")
    assert csv_points(path, "load") == [(0.0, 2.0), (1.0, 4.0)]
    assert csv_points(path, "phase") == [(0.0, 1.0), (1.0, 3.0)]


def test_a_run_written_by_the_harness_can_be_read_back_as_an_input(tmp_path: Path) -> None:
    path = tmp_path / "run.csv"
    path.write_text('"time","load","position"\n0.0,0.5,1e-3\n')
    assert csv_points(path, "load") == [(0.0, 0.5)]


@pytest.mark.parametrize(
    "text",
    [
        "time;load\n0;0,5\n1,5;-2e-3\n",
        "time\tload\n0\t0.5\n1.5\t-2e-3\n",
        "sep=;\ntime;load\n0;0,5\n1,5;-2e-3\n",
        "\ufeff# measured\n# on a Monday\ntime,load\n0,0.5\n# a pause\n1.5,-2e-3\n",
        '\ufeff"time";"load"\n"0";"0,5"\n"1,5";"-0,002"\n',
    ],
)
def test_what_other_programs_write_is_read(tmp_path: Path, text: str) -> None:
    path = tmp_path / "in.csv"
    path.write_text(text, encoding="utf-8")
    assert csv_points(path, "load") == [(0.0, 0.5), (1.5, -2e-3)]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "must begin with 'time'"),
        ("t,load\n0,1\n", "must begin with 'time'"),
        ("time,lod\n0,1\n", "no column 'load'"),
        ("time,load\n0,1\n1,x\n", "line 3"),
        ("time,load\n0\n", "line 2"),
        ("# a comment\ntime;load\n0;1\n1;x\n", "line 4: load = 'x'"),
        ("time,load\n0,1 000,5\n", "line 2"),
        ("time,load\n0,1,5\n", "line 2: 3 cells below 2 headings"),
    ],
)
def test_a_csv_that_cannot_be_used_is_named(tmp_path: Path, text: str, message: str) -> None:
    path = tmp_path / "in.csv"
    path.write_text(text)
    with pytest.raises(ValueError, match=message) as caught:
        csv_points(path, "load")
    assert str(path) in str(caught.value)
