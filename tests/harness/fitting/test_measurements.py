from __future__ import annotations

from math import pi
from pathlib import Path

import numpy as np
import pytest

from slider_resonator.errors import HarnessError
from slider_resonator.fitting.measurements import Measurements, read_measurements


def read(folder: Path, text: str) -> Measurements:
    path = folder / "data.csv"
    path.write_text(text, encoding="utf-8")
    return read_measurements(path)


def test_a_table_has_units_other_names_and_gaps(tmp_path: Path) -> None:
    text = (
        "phase [deg],frequency (kHz),amplitude,velocity [mm/s],steady_velocity_std [mm/s],"
        "blocking_force\n30,20,1e-6,47,0.5,\n\n60,20,1e-6,,,0.2\n"
    )
    with pytest.raises(HarnessError, match="unknown column 'phase_std'"):
        read(tmp_path, text.replace("steady_velocity_std", "phase_std"))
    data = read(tmp_path, text)
    first, second = data.points
    assert first.values["phase"] == pytest.approx(pi / 6)
    assert first.values["drive_frequency"] == pytest.approx(2 * pi * 20e3)
    assert first.quantity == "steady_velocity"
    assert first.measured == pytest.approx(0.047)
    assert first.deviation == pytest.approx(5e-4)
    assert (second.quantity, second.measured, second.deviation) == ("blocking_force", 0.2, None)
    with pytest.raises(HarnessError, match="1 of 2 numbers have a standard deviation; must be all"):
        _ = data.knows_deviations


def test_a_run_begins_at_zero_and_may_lack_values(tmp_path: Path) -> None:
    text = "time [ms],load [mN],velocity,position [um]\n1000,0,0.1,1\n\n2000,50,,2\n4000,50,0.3,3\n"
    data = read(tmp_path, text)
    (run,) = data.runs
    assert run.schedule.times.tolist() == [0.0, 1.0, 3.0]
    assert run.schedule.sampled[:, 1].tolist() == [0.0, 0.05, 0.05]
    assert data.measured == pytest.approx([0.1, 0.3, 1e-6, 2e-6, 3e-6])
    assert data.quantities == ["velocity"] * 2 + ["position"] * 3
    assert np.isnan(run.outputs["velocity"][1])


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "0 rows below the header; must be 1 to"),
        ("phase;load\n1;2\n", "measures nothing; must have a column"),
        ("time [N],velocity\n0,1\n1,2\n", "heading 'time [N]'"),
        ("phase,velocity\n0.1,x\n", "line 2: velocity = 'x': must be a finite number, or empty"),
        ("phase\n0.1\n", "measures nothing; must have a column"),
        ("phse,velocity\n0,1\n", "unknown column 'phse'; did you mean 'phase'?"),
        ("phase [N],velocity\n0,1\n", "heading 'phase [N]': phase = '1 N': not in rad"),
        ("phase,velocity\n,1\n", "row 1: phase is empty; must be a number"),
        ("phase,velocity,velocity_std\n1,1,0\n", "steady_velocity_std = 0: must be above 0"),
        ("velocity,steady_velocity\n1,1\n", "two columns steady_velocity; must be one"),
        ("time,velocity\n0,1\n0,2\n", "time must be in every row, and increase strictly"),
        ("time,load\n0,1\n1,2\n", "must have a column of an output"),
    ],
)
def test_bad_data_are_explained(tmp_path: Path, text: str, said: str) -> None:
    with pytest.raises(HarnessError) as error:
        read(tmp_path, text)
    assert said in str(error.value)
    assert "data.csv" in str(error.value)
