from __future__ import annotations

from math import inf

import numpy as np
import pytest

from slider_resonator.arrays import Array
from slider_resonator.choosing.errors import ErrorEstimate, Readings
from slider_resonator.fmu.record import Record
from slider_resonator.scenes.need_table import AllowedTable

POINTS = np.linspace(0.1, 1.0, 10)
GRID = np.linspace(0.0, 1.0, 201)
TIMES = np.union1d(POINTS, GRID)
NAMES = ("position", "velocity", "mean_velocity", "reversals", "last_event_time")


def record(**signals: float | Array) -> Record:
    outputs = {name: np.zeros(TIMES.size) + signals.get(name, 0.0) for name in NAMES}
    return Record(TIMES, np.zeros((TIMES.size, 3)), outputs, 0.0, 0.0, 0.0)


def error(name: str, found: Record, reference: Record, law: int = 0) -> ErrorEstimate:
    readings = Readings({name: AllowedTable(rel=0.1)}, POINTS, GRID, 0.01, law)
    return readings.errors(found, reference)[name]


def test_signals_are_judged_everywhere_and_numbers_at_the_end() -> None:
    bump = np.where(TIMES < 0.35, 0.3, 0.0)
    reference = record(position=TIMES, mean_velocity=2.0)
    other = record(position=TIMES + bump, mean_velocity=2.0 + bump)
    position, velocity, throughout = (
        error(name, other, reference)
        for name in ("position", "mean_velocity", "mean_velocity_throughout")
    )
    assert position.error == pytest.approx(0.3)
    assert throughout.error == pytest.approx(0.3)
    assert position.magnitude == 1.0
    assert velocity.error < 1e-11
    assert velocity.magnitude == throughout.magnitude == 2.0


def test_events_are_the_nearest_true_ones() -> None:
    """Also where the one that a run shows is not yet, or no longer, the last of the reference."""
    events = 0.1 * np.floor(10.0 * TIMES) + 0.05
    late = np.maximum(0.1 * np.floor(10.0 * TIMES - 1.0), 0.0) + 0.05 + 1e-4
    reference = record(last_event_time=events)
    near = error("event_times", record(last_event_time=late), reference)
    assert near.error == pytest.approx(1e-4)
    far = error("event_times", record(last_event_time=events + 0.03), reference)
    assert far.error == pytest.approx(0.03)
    missed = error("event_times", record(last_event_time=events, reversals=1), reference)
    assert missed.error == inf
    assert missed.reason == "1 reversals instead of 0"


def test_beats_are_frequencies() -> None:
    true, found = (record(mean_velocity=np.sin(2.0 * np.pi * f * TIMES)) for f in (20.0, 20.2))
    estimate = error("beat", found, true)
    assert estimate.error == pytest.approx(0.2, rel=1e-3)
    assert estimate.magnitude == pytest.approx(20.0, rel=1e-3)


def test_nothing_is_known_better_than_to_rounding() -> None:
    same = record(position=TIMES)
    for law, floor in ((0, 1e-12), (1, 1e-10)):
        assert error("position", same, same, law).error == floor
