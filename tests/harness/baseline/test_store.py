"""Golden results in files: written and read back, in an order that diffs well."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from slider_resonator.baseline.judge import SIGNALS
from slider_resonator.baseline.store import (
    DIGITS,
    Recorded,
    key,
    read_recorded,
    recorded_scenes,
    write_recorded,
)
from slider_resonator.checks.measuring import Measurement
from slider_resonator.errors import HarnessError

TIMES = np.array([0.0, 0.1, 0.25])
GOLDEN = {
    "reversals": Measurement(23999.0),
    "steady_velocity": Measurement(None, "slow beat"),
    "steady_status": Measurement("slow_beat"),
    **{name: Measurement(TIMES * (1 + i), times=TIMES) for i, name in enumerate(SIGNALS)},
}
RECORDED = Recorded(
    {key({"phase": 0.4}): GOLDEN, key({"phase": -1.5}): GOLDEN}, {"fmu": "my.fmu", "scene": "mine"}
)


def test_written_results_are_read_back(tmp_path: Path) -> None:
    write_recorded(tmp_path / "mine", RECORDED)
    read = read_recorded(tmp_path / "mine")
    assert read.provenance == RECORDED.provenance
    assert list(read.points) == list(RECORDED.points)
    for golden in read.points.values():
        assert golden["reversals"].value == 23999.0
        assert golden["steady_velocity"].value is None
        assert golden["steady_status"].value == "slow_beat"
        for name in SIGNALS:
            assert np.allclose(golden[name].value, GOLDEN[name].value, rtol=1e-12, atol=0.0)
            times = golden[name].times
            assert times is not None
            assert np.array_equal(times, TIMES)


def test_the_same_results_make_the_same_bytes_whatever_their_order(tmp_path: Path) -> None:
    turned = dict(reversed(GOLDEN.items()))
    write_recorded(tmp_path / "one", RECORDED)
    again = Recorded(dict.fromkeys(RECORDED.points, turned), RECORDED.provenance)
    write_recorded(tmp_path / "other", again)
    for file in (tmp_path / "one").iterdir():
        assert file.read_bytes() == (tmp_path / "other" / file.name).read_bytes()


@given(number=st.floats(allow_nan=False, allow_infinity=False))
def test_numbers_keep_their_digits(number: float, tmp_path_factory: pytest.TempPathFactory) -> None:
    folder = tmp_path_factory.mktemp("numbers") / "mine"
    write_recorded(folder, Recorded({(): {"steady_velocity": Measurement(number)}}, {}))
    (golden,) = read_recorded(folder).points.values()
    assert golden["steady_velocity"].value == pytest.approx(number, rel=10.0 ** (1 - DIGITS))
    assert not str(golden["steady_velocity"].value).startswith("-0.0")


def test_writing_again_replaces_everything_and_leaves_nothing_behind(tmp_path: Path) -> None:
    write_recorded(tmp_path / "mine", RECORDED)
    numbers = {"reversals": Measurement(1.0)}
    write_recorded(tmp_path / "mine", Recorded({(): numbers}, {"fmu": "other.fmu"}))
    assert sorted(path.name for path in (tmp_path / "mine").iterdir()) == [
        "numbers.csv",
        "provenance.csv",
    ]
    assert [path.name for path in tmp_path.iterdir()] == ["mine"]
    assert [path.name for path in recorded_scenes(tmp_path)] == ["mine"]


@pytest.mark.parametrize("name", ["numbers.csv", "trajectory.csv", "provenance.csv"])
def test_a_file_that_is_no_record_is_named_with_its_line(tmp_path: Path, name: str) -> None:
    write_recorded(tmp_path / "mine", RECORDED)
    file = tmp_path / "mine" / name
    file.write_text(file.read_text() + "one,two,three\n")
    line = len(file.read_text().splitlines())
    with pytest.raises(HarnessError, match=rf"{name} line {line}: 3 cells"):
        read_recorded(tmp_path / "mine")
    file.write_text("")
    with pytest.raises(HarnessError, match=rf"{name} line 1: ''; must be '(at|what),"):
        read_recorded(tmp_path / "mine")
    (tmp_path / "mine" / "numbers.csv").unlink()
    with pytest.raises(HarnessError, match=r"numbers.csv: cannot be read"):
        read_recorded(tmp_path / "mine")


@pytest.mark.parametrize(
    ("name", "row", "reason"),
    [
        ("numbers.csv", ",reversals,1,many", "'many': must be a number"),
        ("numbers.csv", ",reversals,1,", "'': must be a number"),
        ("numbers.csv", ",reversal,1,3", "did you mean 'reversals'"),
        ("numbers.csv", ",position,m,3", "unknown quantity 'position'"),
        ("numbers.csv", "phase,reversals,1,3", "'': must be a number"),
        ("trajectory.csv", "phase=x" + ",0" * (1 + len(SIGNALS)), "'x': must be a number"),
        ("trajectory.csv", ",0,?" + ",0" * (len(SIGNALS) - 1), r"'\?': must be a number"),
    ],
)
def test_a_line_that_makes_no_sense_is_named(
    tmp_path: Path, name: str, row: str, reason: str
) -> None:
    write_recorded(tmp_path / "mine", RECORDED)
    file = tmp_path / "mine" / name
    file.write_text(f"{file.read_text()}{row}\n")
    line = len(file.read_text().splitlines())
    with pytest.raises(HarnessError, match=rf"{name} line {line}: .*{reason}"):
        read_recorded(tmp_path / "mine")
