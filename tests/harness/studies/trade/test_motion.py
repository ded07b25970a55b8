"""Errors of motions that are off by a known amount."""

from __future__ import annotations

from dataclasses import replace
from math import inf, nan
from pathlib import Path

import numpy as np
import pytest

from slider_resonator.studies.trade.motion import Motion, errors, last_events, windows
from slider_resonator.studies.trade.task import Task
from tests.harness.studies.trade.scenes import BEAT, TABLE_1, task


@pytest.fixture
def short(tmp_path: Path) -> Task:
    return task(tmp_path, TABLE_1, most_periods=4)


def drifting(task: Task) -> Motion:
    times = task.readings(4)
    wave = np.sin(task.device.drive_frequency * times)
    return Motion(times, 2.0 * times + 1e-6 * wave, 2.0 + 0.5 * wave, last_event=0.9 * times)


def test_equal_motions_have_no_error(short: Task) -> None:
    motion = drifting(short)
    found = errors(short, motion, windows(short, motion, 4), 4)
    assert set(found) == {
        "mean_velocity",
        "slow_displacement",
        "position",
        "velocity",
        "event_times",
    }
    assert not any(found.values())


def test_each_error_is_a_share_of_the_peak(short: Task) -> None:
    motion = drifting(short)
    assert motion.last_event is not None
    truth = windows(short, motion, 4)
    late = replace(
        motion,
        position=1.01 * motion.position,
        velocity=motion.velocity + 0.025,
        last_event=motion.last_event + 1e-3 * short.period,
    )
    found = errors(short, late, truth, 4)
    for name in ("position", "mean_velocity", "slow_displacement"):
        assert found[name] == pytest.approx(0.01), name
    assert found["velocity"] == pytest.approx(0.01)
    assert found["event_times"] == pytest.approx(1e-3), "in drive periods"


def test_a_ripple_is_no_slow_displacement(short: Task) -> None:
    motion = drifting(short)
    wave = np.sin(short.device.drive_frequency * motion.times)
    rippled = replace(motion, position=motion.position + 1e-3 * wave)
    found = errors(short, rippled, windows(short, motion, 4), 4)
    assert found["position"] > 0.05
    assert found["slow_displacement"] < 1e-12
    assert found["mean_velocity"] < 1e-9


def test_a_shorter_run_is_compared_where_it_has_been(short: Task) -> None:
    motion = drifting(short)
    early = motion.times <= 2.0001 * short.period
    half = Motion(motion.times[early], motion.position[early], motion.velocity[early])
    found = errors(short, half, windows(short, motion, 4), 2)
    assert found["position"] == 0.0
    assert "event_times" not in found, "who locates no events has no error of them"


def test_what_is_not_finite_is_infinitely_wrong(short: Task) -> None:
    motion = drifting(short)
    broken = replace(motion, velocity=np.full_like(motion.velocity, nan))
    assert errors(short, broken, windows(short, motion, 4), 4)["velocity"] == inf


def test_the_last_event_up_to_each_time() -> None:
    found = last_events(np.array([0.1, 0.3]), np.array([0.0, 0.1, 0.2, 0.3, 9.0]))
    assert found.tolist() == [0.0, 0.1, 0.1, 0.3, 0.3]
    assert last_events(np.empty(0), np.array([1.0])).tolist() == [0.0]


@pytest.mark.parametrize(("step", "told"), [(1, True), (7, True), (10, False), (100, False)])
def test_a_beat_is_told_by_who_samples_it(tmp_path: Path, step: int, told: bool) -> None:
    beating = task(tmp_path, BEAT)
    assert beating.beat is not None
    ends = beating.ends(1600)[::step]
    course = (ends, np.sin(2.0 * np.pi * 1.001 * beating.beat * ends))
    times = beating.readings(1600)
    motion = Motion(times, times, np.ones_like(times), course=course)
    found = errors(beating, motion, windows(beating, motion, 1600), 1600)
    assert ("beat_frequency" in found) == told, "twenty periods are a beat"
    early = replace(motion, course=(course[0][:1], course[1][:1]))
    assert "beat_frequency" not in errors(beating, early, windows(beating, motion, 1600), 1600)
    if told:
        assert found["beat_frequency"] == pytest.approx(1e-3, rel=1e-3)
