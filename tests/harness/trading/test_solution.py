"""Errors of solutions that are off by a known amount."""

from __future__ import annotations

from dataclasses import replace
from math import inf, nan

import numpy as np
import pytest

from slider_resonator.trading.problem import Problem
from slider_resonator.trading.solution import Solution, errors, last_events, windows
from tests.harness.trading.problems import BEAT, TABLE_1, problem


@pytest.fixture
def short() -> Problem:
    return problem(TABLE_1, max_periods=4)


def drifting(problem: Problem) -> Solution:
    times = problem.readings(4)
    wave = np.sin(problem.device.drive_frequency * times)
    return Solution(times, 2.0 * times + 1e-6 * wave, 2.0 + 0.5 * wave, last_event=0.9 * times)


def test_equal_solutions_have_no_error(short: Problem) -> None:
    solution = drifting(short)
    found = errors(short, solution, windows(short, solution, 4), 4)
    assert set(found) == {
        "mean_velocity",
        "slow_displacement",
        "position",
        "velocity",
        "event_times",
    }
    assert not any(found.values())


def test_each_error_is_a_share_of_the_peak(short: Problem) -> None:
    solution = drifting(short)
    assert solution.last_event is not None
    reference = windows(short, solution, 4)
    late = replace(
        solution,
        position=1.01 * solution.position,
        velocity=solution.velocity + 0.025,
        last_event=solution.last_event + 1e-3 * short.period,
    )
    found = errors(short, late, reference, 4)
    for name in ("position", "mean_velocity", "slow_displacement"):
        assert found[name] == pytest.approx(0.01), name
    assert found["velocity"] == pytest.approx(0.01)
    assert found["event_times"] == pytest.approx(1e-3), "in drive periods"


def test_a_ripple_is_no_slow_displacement(short: Problem) -> None:
    solution = drifting(short)
    wave = np.sin(short.device.drive_frequency * solution.times)
    rippled = replace(solution, position=solution.position + 1e-3 * wave)
    found = errors(short, rippled, windows(short, solution, 4), 4)
    assert found["position"] > 0.05
    assert found["slow_displacement"] < 1e-12
    assert found["mean_velocity"] < 1e-9


def test_a_shorter_run_is_compared_where_it_has_been(short: Problem) -> None:
    solution = drifting(short)
    early = solution.times <= 2.0001 * short.period
    half = Solution(solution.times[early], solution.position[early], solution.velocity[early])
    found = errors(short, half, windows(short, solution, 4), 2)
    assert found["position"] == 0.0
    assert "event_times" not in found, "a method that locates no events has no error of them"


def test_values_that_are_not_finite_have_infinite_error(short: Problem) -> None:
    solution = drifting(short)
    broken = replace(solution, velocity=np.full_like(solution.velocity, nan))
    assert errors(short, broken, windows(short, solution, 4), 4)["velocity"] == inf


def test_the_last_event_up_to_each_time() -> None:
    found = last_events(np.array([0.1, 0.3]), np.array([0.0, 0.1, 0.2, 0.3, 9.0]))
    assert found.tolist() == [0.0, 0.1, 0.1, 0.3, 0.3]
    assert last_events(np.empty(0), np.array([1.0])).tolist() == [0.0]


@pytest.mark.parametrize(("step", "reported"), [(1, True), (7, True), (10, False), (100, False)])
def test_a_beat_needs_enough_samples(step: int, reported: bool) -> None:
    beating = problem(BEAT)
    assert beating.beat is not None
    ends = beating.ends(1600)[::step]
    history = (ends, np.sin(2.0 * np.pi * 1.001 * beating.beat * ends))
    times = beating.readings(1600)
    solution = Solution(times, times, np.ones_like(times), history=history)
    found = errors(beating, solution, windows(beating, solution, 1600), 1600)
    assert ("beat_frequency" in found) == reported, "twenty periods are a beat"
    early = replace(solution, history=(history[0][:1], history[1][:1]))
    assert "beat_frequency" not in errors(beating, early, windows(beating, solution, 1600), 1600)
    if reported:
        assert found["beat_frequency"] == pytest.approx(1e-3, rel=1e-3)
