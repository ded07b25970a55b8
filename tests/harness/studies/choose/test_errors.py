from __future__ import annotations

from math import inf

import numpy as np
import pytest

from slider_resonator.studies.choose.course import MOST_LOOKS, Course, looks_between
from slider_resonator.studies.choose.errors import errors

TIMES = np.linspace(0.1, 1.0, 10)


def course(pitch: float = 1.0, **signals: float | np.ndarray) -> Course:
    zero = np.zeros(TIMES.size)
    names = ("position", "velocity", "mean_velocity", "reversals", "last_event_time")
    grid = np.linspace(0.0, 1.0, 200)
    beat = np.sin(2.0 * np.pi * 20.0 * grid * pitch)
    return Course(TIMES, {name: zero + signals.get(name, 0.0) for name in names}, grid, beat)


def test_signals_are_judged_everywhere_and_numbers_at_the_end() -> None:
    bump = np.where(TIMES < 0.35, 0.3, 0.0)
    truth = course(position=TIMES, mean_velocity=2.0)
    other = course(position=TIMES + bump, mean_velocity=2.0 + bump)
    found = errors(["position", "mean_velocity"], other, truth, 0.01)
    assert found["position"].error == pytest.approx(0.3)
    assert found["position"].size == 1.0
    assert found["mean_velocity"].error < 1e-11
    assert found["mean_velocity"].size == 2.0


def test_events_are_the_nearest_true_ones_even_across_a_look() -> None:
    events = np.array([0.05, 0.15, 0.25, 0.25, 0.45, 0.45, 0.65, 0.75, 0.75, 0.95])
    late = np.roll(events, 1) + 1e-4
    late[0] = 0.05
    truth, other = course(last_event_time=events), course(last_event_time=late)
    assert errors(["event_times"], other, truth, 0.01)["event_times"].error == pytest.approx(1e-4)
    missed = errors(["event_times"], course(last_event_time=events, reversals=1), truth, 0.01)
    assert missed["event_times"].error == inf
    assert missed["event_times"].reason == "1 reversals instead of 0"


def test_beats_are_frequencies() -> None:
    found = errors(["beat"], course(pitch=1.01), course(), 0.01)["beat"]
    assert found.error == pytest.approx(0.2, rel=1e-3)
    assert found.size == pytest.approx(20.0, rel=1e-3)


def test_nothing_is_known_better_than_to_rounding() -> None:
    same = course(position=TIMES)
    for law, floor in ((0, 1e-12), (1, 1e-10)):
        assert errors(["position"], same, same, 0.01, law)["position"].error == floor


def test_looks_show_all_phases() -> None:
    points = np.arange(100_000) / 16.0
    looks = looks_between(points, 0.0, points[-1])
    assert MOST_LOOKS - 1 <= looks.size <= MOST_LOOKS + 1
    assert np.isin(looks, points).all()
    counts = np.bincount((16.0 * looks).astype(int) % 16, minlength=16)
    assert np.min(counts) > 0.5 * np.mean(counts)
