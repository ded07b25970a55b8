"""Golden results: in files, and compared with new ones."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from slider_resonator.baseline.golden import (
    DIGITS,
    SIGNALS,
    Golden,
    Recorded,
    compare_golden,
    key,
    read_recorded,
    recorded_scenes,
    write_recorded,
)
from slider_resonator.baseline.work import scene_digest
from slider_resonator.checks.compare import Check, compare
from slider_resonator.checks.measuring import Measurement
from slider_resonator.checks.verdict import sentence
from slider_resonator.errors import HarnessError, SceneError
from slider_resonator.scenes.scene import ScenePoint
from slider_resonator.scenes.scene_files import find_scene
from slider_resonator.scenes.schema import RunTable
from tests.harness.scene_text import scene_of

TIMES = np.linspace(0.0, 0.1, 48)
WAVE = 1e-3 * np.sin(500.0 * TIMES)


@pytest.fixture(scope="module")
def point() -> ScenePoint:
    return ScenePoint(find_scene("table_1"))


def test_a_scene_that_is_written_in_part_is_not_recorded(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    write_recorded(tmp_path / "mine", RECORDED)
    assert recorded_scenes(tmp_path) == [tmp_path / "mine"]

    def full(path: Path, *_: Any) -> None:
        raise HarnessError(f"{path}: no space left")

    monkeypatch.setattr("slider_resonator.baseline.golden.write_csv", full)
    with pytest.raises(HarnessError, match="no space left"):
        write_recorded(tmp_path / "mine", RECORDED)
    assert recorded_scenes(tmp_path) == []


def judged(point: ScenePoint, name: str, *values: Any) -> Check:
    """Compare a golden value of a quantity with the one that is measured now."""
    golden, now = (
        {name: Measurement(value, times=TIMES[: len(value)] if np.ndim(value) else None)}
        for value in values
    )
    return compared(point, golden, now)


def compared(point: ScenePoint, golden: Golden, now: Golden) -> Check:
    ((comparison, measured, expected),) = compare_golden(point, golden, now, 1e-8)
    return compare(comparison, measured, expected, point)


@pytest.mark.parametrize(
    ("name", "golden", "now", "passed"),
    [
        ("steady_velocity", 0.1, 0.1 * (1 + 9e-9), True),
        ("steady_velocity", 0.1, 0.1 * (1 + 2e-8), False),
        ("steady_velocity", 0.0, 1e-12, True),
        ("steady_velocity", None, None, True),
        ("steady_velocity", 0.1, None, False),
        ("steady_status", "steady", "steady", True),
        ("steady_status", "steady", "unstable", False),
        ("reversals", 199.0, 199.0, True),
        ("reversals", 199.0, 200.0, False),
        ("position", WAVE, WAVE * (1 + 9e-9), True),
        ("position", WAVE, WAVE * (1 + 2e-8), False),
        ("contact_mode", np.sign(WAVE), -np.sign(WAVE), False),
        ("event_times", 557.0 * TIMES, 557.0 * TIMES + 9e-9, True),
        ("event_times", 557.0 * TIMES, 557.0 * TIMES + 2e-8, False),
    ],
)
def test_judged_changes(point: ScenePoint, name: str, golden: Any, now: Any, passed: bool) -> None:
    verdict = judged(point, name, golden, now)
    assert verdict.passed is passed, sentence(verdict)
    assert verdict.against == "baseline"


def test_missing_quantities_are_changes(point: ScenePoint) -> None:
    golden = {"reversals": Measurement(199.0)}
    new, gone = compared(point, {}, golden), compared(point, golden, {})
    assert (new.passed, gone.passed) == (False, False)
    assert "no longer allows it" in sentence(gone)
    with pytest.raises(SceneError, match="has other points"):
        judged(point, "position", WAVE, WAVE[:20])


STORED_TIMES = np.array([0.0, 0.1, 0.25])
GOLDEN = {
    "reversals": Measurement(23999.0),
    "steady_velocity": Measurement(None, "slow beat"),
    "steady_status": Measurement("slow_beat"),
    **{
        name: Measurement(STORED_TIMES * (1 + i), times=STORED_TIMES)
        for i, name in enumerate(SIGNALS)
    },
}
RECORDED = Recorded(
    {key({"phase": 0.4}): GOLDEN, key({"phase": -1.5}): GOLDEN}, {"fmu": "my.fmu", "scene": "mine"}
)


def test_a_digest_notices_whether_lines_are_interpolated() -> None:
    line = "[inputs]\nload = { ramp = [[0.0, 0.0], [0.01, 0.1]] }\n"
    held = scene_of(line + "[run]\nstop_time = 0.01\nstep_size = 1e-3\n")
    assert scene_digest(held.interpolating(True)) != scene_digest(held)


def test_a_key_that_is_not_set_leaves_a_digest_as_it_was() -> None:
    class LaterTable(RunTable):
        another: bool = False

    scene = scene_of("[run]\nstop_time = 0.01\nstep_size = 1e-3\nread_twice = true\n")
    assert scene.run is not None
    keys = scene.run.model_dump(exclude_unset=True)
    later = replace(scene, run=LaterTable(**keys))
    changed = replace(scene, run=LaterTable(**keys, another=True))
    recorded = "f45d450380488d66d4a970c1972c1b010f4947ab537870564829067389cb924d"
    assert scene_digest(scene) == scene_digest(later) == recorded
    assert scene_digest(changed) != recorded


def test_written_results_are_read_back(tmp_path: Path) -> None:
    """Others written in their place replace everything and leave nothing behind."""
    write_recorded(tmp_path / "mine", RECORDED)
    read = read_recorded(tmp_path / "mine")
    assert read.provenance == RECORDED.provenance
    assert list(read.points) == list(RECORDED.points)
    for golden in read.points.values():
        for name in ("reversals", "steady_velocity", "steady_status"):
            assert golden[name].value == GOLDEN[name].value
        for name in SIGNALS:
            assert np.allclose(golden[name].value, GOLDEN[name].value, rtol=1e-12, atol=0.0)
            assert golden[name].times == pytest.approx(STORED_TIMES, rel=0.0, abs=0.0)
    numbers = {"reversals": Measurement(1.0)}
    write_recorded(tmp_path / "mine", Recorded({(): numbers}, {"fmu": "other.fmu"}))
    files = {path.name for path in (tmp_path / "mine").iterdir()}
    assert files == {"numbers.csv", "provenance.csv"}
    assert [path.name for path in tmp_path.iterdir()] == ["mine"]
    assert [path.name for path in recorded_scenes(tmp_path)] == ["mine"]


@settings(max_examples=10)
@example(numbers=[-0.0])
@given(st.lists(st.floats(allow_nan=False, allow_infinity=False), min_size=1, max_size=20))
def test_digits_are_kept(tmp_path_factory: pytest.TempPathFactory, numbers: list[float]) -> None:
    folder = tmp_path_factory.mktemp("numbers") / "mine"
    points = {
        key({"phase": n}): {"steady_velocity": Measurement(one)} for n, one in enumerate(numbers)
    }
    write_recorded(folder, Recorded(points, {}))
    for golden, number in zip(read_recorded(folder).points.values(), numbers, strict=True):
        value = golden["steady_velocity"].value
        assert value == pytest.approx(number, rel=10.0 ** (1 - DIGITS))
        assert str(value) != "-0.0"


@pytest.mark.parametrize(
    ("name", "row", "reason"),
    [
        ("numbers.csv", "one,two,three", "3 cells"),
        ("trajectory.csv", "one,two,three", "3 cells"),
        ("provenance.csv", "one,two,three", "3 cells"),
        ("numbers.csv", ",reversals,1,many", "'many': must be a number"),
        ("numbers.csv", ",reversals,1,", "'': must be a number"),
        ("numbers.csv", ",reversal,1,3", "did you mean 'reversals'"),
        ("numbers.csv", ",position,m,3", "unknown quantity 'position'"),
        ("numbers.csv", "phase,reversals,1,3", "'': must be a number"),
        ("trajectory.csv", "phase=x" + ",0" * (1 + len(SIGNALS)), "'x': must be a number"),
        ("trajectory.csv", ",0,?" + ",0" * (len(SIGNALS) - 1), r"'\?': must be a number"),
    ],
)
def test_a_line_without_sense_is_named(tmp_path: Path, name: str, row: str, reason: str) -> None:
    write_recorded(tmp_path / "mine", RECORDED)
    file = tmp_path / "mine" / name
    file.write_text(f"{file.read_text()}{row}\n")
    line = len(file.read_text().splitlines())
    with pytest.raises(HarnessError, match=rf"{name} line {line}: .*{reason}"):
        read_recorded(tmp_path / "mine")
    file.write_text("")
    with pytest.raises(HarnessError, match=rf"{name} line 1: ''; must be '(at|what),"):
        read_recorded(tmp_path / "mine")
    (tmp_path / "mine" / "numbers.csv").unlink()
    with pytest.raises(HarnessError, match=r"numbers.csv cannot be read"):
        read_recorded(tmp_path / "mine")
