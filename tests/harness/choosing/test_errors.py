from __future__ import annotations

from math import inf

import numpy as np
import pytest

from slider_resonator.choosing.errors import errors
from slider_resonator.choosing.stretch import MAX_CHECKPOINTS, Samples, checkpoints_between

TIMES = np.linspace(0.1, 1.0, 10)


def samples(pitch: float = 1.0, **signals: float | np.ndarray) -> Samples:
    zero = np.zeros(TIMES.size)
    names = ("position", "velocity", "mean_velocity", "reversals", "last_event_time")
    grid = np.linspace(0.0, 1.0, 200)
    beat = np.sin(2.0 * np.pi * 20.0 * grid * pitch)
    return Samples(TIMES, {name: zero + signals.get(name, 0.0) for name in names}, grid, beat)


def test_signals_are_judged_everywhere_and_numbers_at_the_end() -> None:
    bump = np.where(TIMES < 0.35, 0.3, 0.0)
    reference = samples(position=TIMES, mean_velocity=2.0)
    other = samples(position=TIMES + bump, mean_velocity=2.0 + bump)
    found = errors(["position", "mean_velocity"], other, reference, 0.01)
    assert found["position"].error == pytest.approx(0.3)
    assert found["position"].magnitude == 1.0
    assert found["mean_velocity"].error < 1e-11
    assert found["mean_velocity"].magnitude == 2.0


def test_events_are_the_nearest_true_ones_even_across_a_look() -> None:
    events = np.array([0.05, 0.15, 0.25, 0.25, 0.45, 0.45, 0.65, 0.75, 0.75, 0.95])
    late = np.roll(events, 1) + 1e-4
    late[0] = 0.05
    reference, other = samples(last_event_time=events), samples(last_event_time=late)
    assert errors(["event_times"], other, reference, 0.01)["event_times"].error == pytest.approx(
        1e-4
    )
    missed = errors(["event_times"], samples(last_event_time=events, reversals=1), reference, 0.01)
    assert missed["event_times"].error == inf
    assert missed["event_times"].reason == "1 reversals instead of 0"


def test_beats_are_frequencies() -> None:
    found = errors(["beat"], samples(pitch=1.01), samples(), 0.01)["beat"]
    assert found.error == pytest.approx(0.2, rel=1e-3)
    assert found.magnitude == pytest.approx(20.0, rel=1e-3)


def test_nothing_is_known_better_than_to_rounding() -> None:
    same = samples(position=TIMES)
    for law, floor in ((0, 1e-12), (1, 1e-10)):
        assert errors(["position"], same, same, 0.01, law)["position"].error == floor


def test_looks_show_all_phases() -> None:
    points = np.arange(100_000) / 16.0
    checkpoints = checkpoints_between(points, 0.0, points[-1])
    assert MAX_CHECKPOINTS - 1 <= checkpoints.size <= MAX_CHECKPOINTS + 1
    assert np.isin(checkpoints, points).all()
    counts = np.bincount((16.0 * checkpoints).astype(int) % 16, minlength=16)
    assert np.min(counts) > 0.5 * np.mean(counts)


def test_signals_are_compared_at_the_start_too() -> None:
    points = np.arange(10.0)
    assert np.array_equal(checkpoints_between(points, 0.0, 9.0), points)
