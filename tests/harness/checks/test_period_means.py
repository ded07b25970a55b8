from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from slider_resonator.checks.period_means import (
    last_events,
    mean_velocities,
    reversal_counts,
    stick_fractions,
)
from slider_resonator.device.device import Device
from slider_resonator.device.drive_periods import DrivePeriods
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.resolved.simulate import simulate
from slider_resonator.references.resolved.trajectory import Trajectory

PERIOD = 2.0 * np.pi / 3500.0
PERIODS = DrivePeriods(PERIOD)
TIMES = np.linspace(0.0, 4.1 * PERIOD, 30)
STICKY = Device(base_amplitude=5e-8)


def run_of(device: Device, times: np.ndarray = TIMES) -> Trajectory:
    held = [HeldInputs(0.0, float(TIMES[-1]))]
    every = np.union1d(times, PERIODS.ends(times))
    return simulate(device, held, every)


def test_ends_are_those_of_the_last_whole_period_and_first_since_the_start() -> None:
    times = np.array([0.0, 0.4, 1.0 - 1e-12, 1.3, 2.0, 7.9])
    begin, end = DrivePeriods(1.0).ends(times).T
    assert begin.tolist() == [0.0, 0.0, 0.0, 0.0, 1.0, 6.0]
    assert end.tolist() == [0.0, 0.4, 1.0 - 1e-12, 1.0, 2.0, 7.0]


def test_means_are_travel_over_time() -> None:
    device = replace(STICKY, initial_velocity=3e-4)
    run = run_of(device)
    means = mean_velocities(run, TIMES, PERIODS)
    assert means[0] == 3e-4, "at the start it is the velocity"
    position = run.position[np.searchsorted(run.time, TIMES)]
    first = TIMES[1:] < PERIOD
    assert means[1:][first] == pytest.approx(position[1:][first] / TIMES[1:][first])
    at = {end: float(run.position[np.searchsorted(run.time, end * PERIOD)]) for end in (3, 4)}
    assert means[-1] == pytest.approx((at[4] - at[3]) / PERIOD, rel=1e-9)


def test_stick_fractions_are_those_of_finely_sampled_modes() -> None:
    fine = np.linspace(0.0, TIMES[-1], 100_001)
    sticks = run_of(STICKY, fine)
    stuck = (sticks.contact_mode[np.searchsorted(sticks.time, fine)] == 0).astype(float)
    shares = stick_fractions(run_of(STICKY), TIMES, PERIODS)
    assert shares[0] == 1.0
    for time, share in zip(TIMES[1:], shares[1:], strict=True):
        begin, end = PERIODS.ends(np.array([time]))[0]
        within = (fine >= begin) & (fine < end)
        assert share == pytest.approx(stuck[within].mean(), abs=2e-4)
    assert 0.0 < shares[-1] < 1.0


def test_counts_and_last_events_open_where_a_point_coincides_with_an_event() -> None:
    run = run_of(Device())
    event = float(run.reversal_times[2])
    times = np.array([0.0, event - 0.01 * PERIOD, event, event + 0.01 * PERIOD])
    counts = reversal_counts(run, times, PERIODS)
    assert counts.lower.tolist() == [0.0, 2.0, 2.0, 3.0]
    assert counts.upper.tolist() == [0.0, 2.0, 3.0, 3.0]
    events = last_events(run, times, PERIODS)
    assert events.middle[-1] * PERIOD == pytest.approx(event)
    assert events.lower[2] < events.upper[2]


def test_periods_of_a_drive_that_changes_end_where_they_are_whole() -> None:
    periods = DrivePeriods(1.0, (0.0, 1.5, 3.5), (0.0, 1.5, 2.5))
    begin, end = periods.ends(np.array([0.9, 1.2, 2.4, 3.5])).T
    assert begin == pytest.approx([0.0, 0.0, 0.0, 1.0])
    assert end == pytest.approx([0.9, 1.0, 1.0, 2.5])
    assert periods.lengths(np.array([3.5])) == pytest.approx([1.5])
