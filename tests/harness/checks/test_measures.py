"""Measures of sampled signals, on signals that are known."""

from __future__ import annotations

import numpy as np
import pytest

from slider_resonator.checks.measures import (
    Tube,
    dominant_frequency,
    last_step_velocity,
    mismatch_share,
    no_tube,
    peak,
    ripple_amplitude,
    share_of,
    slow_displacement,
)

PERIOD = 0.002


def test_rest_agrees_only_with_rest() -> None:
    assert share_of(0.0, 0.0) == 0.0
    assert share_of(1e-300, 0.0) == np.inf


def test_a_signal_that_is_not_finite_never_passes() -> None:
    signal = np.array([1.0, np.nan])
    for reference in (np.ones(2), np.zeros(2)):
        assert not share_of(peak(signal - reference), peak(reference)) <= 1e9


def test_mismatch_counts_points() -> None:
    error = np.array([0.0, 1.0, 0.0, np.nan])
    assert mismatch_share(error) == 0.5


@pytest.mark.parametrize("frequency", [11.140846, 3.3, 40.0])
def test_a_frequency_between_the_lines_of_the_spectrum_is_found(frequency: float) -> None:
    times = np.linspace(0.0, 3.6, 2001)
    angle = 2.0 * np.pi * frequency * times
    signal = 0.1 + 0.02 * times + np.sin(angle + 0.3) + 0.3 * np.cos(3.0 * angle)
    found = dominant_frequency(times, signal)
    assert found == pytest.approx(frequency, rel=1e-8), "finer than 1 / duration = 0.28 Hz"


def test_the_strongest_oscillation_wins() -> None:
    times = np.linspace(0.0, 4.0, 4001)
    signal = np.sin(2.0 * np.pi * 7.0 * times) + 2.0 * np.sin(2.0 * np.pi * 31.0 * times)
    assert dominant_frequency(times, signal) == pytest.approx(31.0, rel=1e-3)


@pytest.mark.parametrize(
    ("times", "signal"),
    [
        (np.arange(8.0), np.arange(8.0)),
        (np.arange(32.0) ** 2, np.arange(32.0)),
        (np.arange(32.0), np.full(32, 3.0)),
    ],
)
def test_records_without_an_answer_are_refused(times: np.ndarray, signal: np.ndarray) -> None:
    with pytest.raises(ValueError, match=r"equal steps|does not oscillate"):
        dominant_frequency(times, signal)


def test_the_amplitude_is_found_beside_drift_and_harmonics() -> None:
    times = np.arange(0, 201) * PERIOD / 20
    angle = 2.0 * np.pi * times / PERIOD
    position = 0.13 * times + 6.76e-5 * np.sin(angle - 0.7) + 1e-5 * np.sin(3.0 * angle)
    assert ripple_amplitude(times, position, PERIOD) == pytest.approx(6.76e-5, rel=5e-3)


def test_without_harmonics_it_is_exact() -> None:
    times = np.arange(0, 201) * PERIOD / 20
    position = 0.13 * times + 6.76e-5 * np.sin(2.0 * np.pi * times / PERIOD)
    assert ripple_amplitude(times, position, PERIOD) == pytest.approx(6.76e-5, rel=1e-12)


@pytest.mark.parametrize(("points", "periods"), [(4, 20), (20, 2)])
def test_a_record_that_cannot_show_it_is_refused(points: int, periods: int) -> None:
    times = np.arange(0, points * periods + 1) * PERIOD / points
    with pytest.raises(ValueError, match="ripple needs"):
        ripple_amplitude(times, times, PERIOD)


@pytest.mark.parametrize("amplitude", [0.0, 1.0, 100.0])
def test_ripple_leaves_no_trace_and_a_drift_is_seen_half_a_period_late(amplitude: float) -> None:
    times = np.arange(0, 321) * PERIOD / 16
    ripple = amplitude * np.sin(2.0 * np.pi * times / PERIOD + 0.3)
    slow = slow_displacement(times, 5.0 * times + ripple, PERIOD)
    assert len(slow) == 321 - 16
    expected = 5.0 * (times[16:] - PERIOD / 2.0)
    assert np.abs(slow - expected).max() < 1e-12 * (1.0 + amplitude)


def test_a_record_shorter_than_a_period_is_refused() -> None:
    with pytest.raises(ValueError, match="shorter than the period"):
        slow_displacement(np.array([0.0, 0.001]), np.zeros(2), PERIOD)


MIDDLE = np.array([0.0, 1.0, 0.0])
BELOW, ABOVE = np.array([0.0, 0.5, 0.1]), np.array([0.0, 0.0, 0.2])
TUBE = Tube(MIDDLE, MIDDLE - BELOW, MIDDLE + ABOVE)


def test_only_what_is_outside_counts() -> None:
    assert TUBE.outside(MIDDLE).tolist() == [0.0, 0.0, 0.0]
    assert np.allclose(TUBE.outside(np.array([0.1, 0.4, -0.05])), [0.1, 0.1, 0.0])


def test_without_width_it_is_the_difference() -> None:
    signal = np.array([0.3, 0.9, -0.2])
    assert no_tube(MIDDLE).outside(signal).tolist() == np.abs(signal - MIDDLE).tolist()


def test_what_is_no_number_is_never_inside() -> None:
    assert np.isnan(TUBE.outside(np.array([np.nan, 1.0, 0.0]))[0])
    assert TUBE.outside(np.array([0.0, np.inf, 0.0]))[1] == np.inf


def test_the_travel_of_the_last_step_alone_counts() -> None:
    times = np.array([0.0, 0.1, 0.3, 0.5])
    assert last_step_velocity(times, np.array([5.0, 1.0, 2.0, 2.5])) == pytest.approx(2.5)
