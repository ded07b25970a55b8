from math import pi
from pathlib import Path

import numpy as np
import pytest

from slider_resonator.device.interface import VARIABLES
from slider_resonator.errors import HarnessError
from slider_resonator.fitting.measurements import Measurements
from slider_resonator.fitting.notes import data_notes
from slider_resonator.fitting.reading import measurements_of, read_measurements
from tests.harness.golden import assert_mistakes_as_before


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
    assert (second.quantity, second.measured) == ("blocking_force", 0.2)
    with pytest.raises(HarnessError, match="1 of 2 numbers have a standard deviation; must be all"):
        _ = data.knows_deviations


def test_numbers_are_those_that_were_typed(tmp_path: Path) -> None:
    data = read(tmp_path, "load [mN],velocity [mm/s]\n30.1,46.3\n1200,-37.7\n")
    assert [one.values["load"] for one in data.points] == [0.0301, 1.2]
    assert data.measured.tolist() == [0.0463, -0.0377]
    assert VARIABLES["load"].in_si("30.1 mN") == 0.0301


def test_a_run_keeps_its_times_and_may_lack_values(tmp_path: Path) -> None:
    text = "Time [ms],load [mN],velocity,position [um]\n0,0,0.1,1\n\n2000,50,nan,2\n4000,50,0.3,3\n"
    data = read(tmp_path, text)
    (schedule,) = data.runs.values()
    assert schedule.times.tolist() == [0.0, 2.0, 4.0]
    assert schedule.sampled[:, 1].tolist() == [0.0, 0.05, 0.05]
    assert data.measured == pytest.approx([0.1, 0.3, 1e-6, 2e-6, 3e-6])
    assert data.quantities.tolist() == ["velocity"] * 2 + ["position"] * 3
    assert [one.row for one in data.points[:2]] == ["line 2", "line 5"]
    assert data.times.tolist() == [0.0, 4.0, 0.0, 2.0, 4.0]
    assert not data.notes


def test_a_recording_that_begins_later_is_run_from_time_0(tmp_path: Path) -> None:
    data = read(tmp_path, "time [ms],load [mN],velocity,velocity_std\n3.2,5,0.1,1\n4,7,0.2,1\n")
    (schedule,) = data.runs.values()
    assert schedule.times == pytest.approx([0.0, 3.2e-3, 4e-3])
    assert schedule.sampled[:, 1] == pytest.approx([5e-3, 5e-3, 7e-3])
    assert data.measured.tolist() == [0.1, 0.2]
    assert data.deviations.tolist() == [1.0, 1.0]
    (note,) = data.notes
    assert "data.csv: begins at 3.2 ms; the device starts at time 0 in its initial state" in note


PLAIN = "phase [deg],frequency [kHz],steady_velocity [mm/s]\n30,20,47\n60,20,50\n"


@pytest.mark.parametrize(
    ("content", "notes"),
    [
        (PLAIN.encode(), ()),
        (PLAIN.replace(",", "\t").encode("utf-16"), ()),
        (PLAIN.replace("\n", ",\n").encode(), ()),
        (
            ("Nr.," + PLAIN).replace("\n3", "\n1,3").replace("\n6", "\n2,6").encode(),
            ("ignored 'Nr.': no numbers, or row numbers",),
        ),
        (b"Phase [deg],FREQUENCY [kHz],Steady Velocity (mm/s)\n30,20,47\n60,20,50\n", ()),
        (
            "phase [°],frequency [kHz],velocity [mm/s],Prüfer,when\n30,20,47,Jürg,10:02\n"
            "45,20,NaN,,10:03\n,,,,\n50,20,,warm,\n60,20,50,,\n".encode("cp1252"),
            (
                "ignored 'Prüfer', 'when': no numbers, or row numbers",
                "2 of 4 rows skipped: nothing measured",
            ),
        ),
    ],
)
def test_tables_of_other_programs(tmp_path: Path, content: bytes, notes: tuple[str, ...]) -> None:
    path = tmp_path / "data.csv"
    path.write_bytes(content)
    data = read_measurements(path)
    assert [point.values["phase"] for point in data.points] == pytest.approx([pi / 6, pi / 3])
    assert data.points[0].values["drive_frequency"] == pytest.approx(2 * pi * 20e3)
    assert data.measured.tolist() == pytest.approx([0.047, 0.050])
    assert data.notes == tuple(f"{path}: {note}" for note in notes)


def test_columns_of_a_script_are_read_as_a_file_is(tmp_path: Path) -> None:
    path = tmp_path / "data.csv"
    path.write_text(PLAIN)
    table = {"phase [deg]": [45], "velocity [mm/s]": [40], "when": ["10:02"], "by": [None]}
    data = measurements_of([path, table, str(path)])
    assert data.measured.tolist() == pytest.approx([0.047, 0.050, 0.040, 0.047, 0.050])
    assert "data 2: ignored 'when', 'by': no numbers, or row numbers" in data.notes
    with pytest.raises(HarnessError, match=r"data: row 1: velocity \[mm/s\] = 'fast': must be"):
        measurements_of(table | {"velocity [mm/s]": ["fast"]})


def test_a_run_has_the_names_of_a_table_for_the_drive(tmp_path: Path) -> None:
    data = read(tmp_path, "time,frequency [kHz],velocity\n0,20,0\n1,21,0.1\n")
    (schedule,) = data.runs.values()
    signal = schedule.tuning["drive_frequency"]
    assert signal.values == pytest.approx((2 * pi * 20e3, 2 * pi * 21e3))


def test_bad_data_are_explained(tmp_path: Path) -> None:
    assert_mistakes_as_before("data_mistakes.txt", tmp_path / "data.csv", read_measurements)
    with pytest.raises(HarnessError, match=r"one of .*steady_velocity, tangential_force, time, "):
        read(tmp_path, "phase,velocty\n0,1\n")


def test_data_that_leave_doubts_are_noted() -> None:
    """A phase and a load that are not given, and a frequency that may be in Hz."""
    columns = {"velocity": [0.1, np.nan], "force": [np.nan, 0.2]}
    phase, load = data_notes(measurements_of(columns), {})
    assert "no phase is given, and 0 rad assumed" in phase
    assert "no load is given, and 0 N assumed" in load
    held = {"phase": 0.3, "load": 0.1}
    assert not data_notes(measurements_of(columns).under(held), {})
    assert not data_notes(measurements_of({"force": [0.2]}).under({"phase": 0.3}), {})
    columns = {"phase": [0.2], "load": [0], "frequency": [557], "velocity": [0.1]}
    (note,) = data_notes(measurements_of(columns), {})
    assert note.startswith("data: drive_frequency = 557 is in rad/s")
    assert note.endswith('write "drive_frequency [Hz]" as heading')
    columns["frequency [Hz]"] = columns.pop("frequency")
    assert not data_notes(measurements_of(columns), {})
