"""Measures of sampled signals, their natural scales and overviews."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from slider_resonator.checks.compare import MAX_POINTS, Curves, curves_of, overview_of
from slider_resonator.checks.measures import (
    Tube,
    dominant_frequency,
    ripple_amplitude,
    share_of,
    slow_displacement,
)
from slider_resonator.checks.measuring import Measurement
from slider_resonator.checks.natural_scale import NEAR_ZERO, smallest_reference
from slider_resonator.checks.reference_side import SteadyReferences
from slider_resonator.device.device import Device
from tests.harness.verdicts import SIGNAL

PERIOD = 0.002


def test_rest_agrees_only_with_rest() -> None:
    assert share_of(0.0, 0.0) == 0.0
    assert share_of(1e-300, 0.0) == np.inf


@pytest.mark.parametrize("frequency", [11.140846, 3.3, 40.0])
def test_a_frequency_between_the_lines_of_the_spectrum_is_found(frequency: float) -> None:
    times = np.linspace(0.0, 3.6, 2001)
    angle = 2.0 * np.pi * frequency * times
    signal = 0.1 + 0.02 * times + np.sin(angle + 0.3) + 0.3 * np.cos(3.0 * angle)
    found = dominant_frequency(times, signal)
    assert found == pytest.approx(frequency, rel=1e-8), "finer than 1 / duration = 0.28 Hz"


def sampled(points: int, periods: int) -> np.ndarray:
    return np.arange(points * periods + 1) * PERIOD / points


@pytest.mark.parametrize(
    ("measure", "arguments", "said"),
    [
        (dominant_frequency, (np.arange(8.0), np.arange(8.0)), "equal steps"),
        (dominant_frequency, (np.arange(32.0) ** 2, np.arange(32.0)), "equal steps"),
        (dominant_frequency, (np.arange(32.0), np.full(32, 3.0)), "does not oscillate"),
        (ripple_amplitude, (sampled(4, 20), sampled(4, 20), PERIOD), "ripple needs"),
        (ripple_amplitude, (sampled(20, 2), sampled(20, 2), PERIOD), "ripple needs"),
        (slow_displacement, (sampled(4, 20)[:3], np.zeros(3), PERIOD), "shorter than the period"),
    ],
)
def test_a_record_that_cannot_show_it_is_refused(
    measure: Callable[..., object], arguments: tuple[object, ...], said: str
) -> None:
    with pytest.raises(ValueError, match=said):
        measure(*arguments)


def test_without_harmonics_it_is_exact() -> None:
    times = sampled(20, 10)
    position = 0.13 * times + 6.76e-5 * np.sin(2.0 * np.pi * times / PERIOD)
    assert ripple_amplitude(times, position, PERIOD) == pytest.approx(6.76e-5, rel=1e-12)


@pytest.mark.parametrize("amplitude", [0.0, 1.0, 100.0])
def test_ripple_leaves_no_trace_and_a_drift_is_seen_half_a_period_late(amplitude: float) -> None:
    times = sampled(16, 20)
    ripple = amplitude * np.sin(2.0 * np.pi * times / PERIOD + 0.3)
    slow = slow_displacement(times, 5.0 * times + ripple, PERIOD)
    assert len(slow) == 321 - 16
    expected = 5.0 * (times[16:] - PERIOD / 2.0)
    assert np.abs(slow - expected).max() < 1e-12 * (1.0 + amplitude)


def test_only_what_is_outside_counts() -> None:
    middle, lower = np.array([0.0, 1.0, 0.0]), np.array([0.0, 0.5, -0.1])
    tube = Tube(middle, lower, np.array([0.0, 1.0, 0.2]))
    assert tube.outside(middle).tolist() == [0.0, 0.0, 0.0]
    assert np.allclose(tube.outside(np.array([0.1, 0.4, -0.05])), [0.1, 0.1, 0.0])


TABLE_1 = Device()
STILL = replace(TABLE_1, base_amplitude=0.0)
FREE = replace(TABLE_1, friction_coefficient=0.0)
RESONANT = replace(FREE, damping_ratio=0.0, resonator_frequency=3500.0 * (1 / 1.1) ** 0.5)
CHANGE = 2.0 * 0.1 * 2.0 / (1.1 * 3500.0)
"""Of the velocity by friction, in a radian of the drive."""


@pytest.mark.parametrize(
    ("quantity", "device", "scale"),
    [
        ("steady_velocity", TABLE_1, pytest.approx(910.947 / (1.1 * 3500.0), rel=1e-5)),
        ("position", TABLE_1, pytest.approx(67.603e-6, rel=1e-4)),
        ("blocking_force", TABLE_1, pytest.approx(2 * 0.1 * (1.0 + 1.0))),
        ("normal_force", TABLE_1, 2.0),
        # Without vibration friction gives the scale.
        ("velocity", STILL, pytest.approx(CHANGE)),
        ("position", STILL, pytest.approx(CHANGE / 3500.0)),
        # These have none: at resonance the vibration grows for ever, a beat is as slow as it likes.
        ("velocity", replace(FREE, base_amplitude=0.0), 0.0),
        ("velocity", RESONANT, 0.0),
        ("beat_frequency", TABLE_1, 0.0),
    ],
)
def test_natural_scales(quantity: str, device: Device, scale: float) -> None:
    """Those of table 1 are the paper's."""
    assert smallest_reference(quantity, device) / NEAR_ZERO == scale


def overview(count: int, *quantities: str, tube: bool = False) -> Curves:
    """Return the overview of signals over 1 s whose reference is twice what is found."""
    times = np.linspace(0.0, 1.0, count)
    twice = 2.0 * times
    expected = Tube(twice, twice, twice) if tube else twice
    checks = [replace(SIGNAL, quantity=quantity) for quantity in quantities]
    curves = [curves_of(check, Measurement(times, times=times), expected) for check in checks]
    found = overview_of([one for one in curves if one is not None])
    assert found is not None
    return found


def test_the_slowest_signal_is_shown_whatever_the_order() -> None:
    quantities = ("velocity", "position", "mean_velocity_in_run")
    for order in (quantities, quantities[::-1]):
        found = overview(9, *order)
        assert found.check.quantity == "mean_velocity_in_run"
        assert np.array_equal(found.reference, 2.0 * found.fmu)


def test_a_long_slow_signal_is_thinned_and_of_a_fast_one_the_end_is_shown_in_full() -> None:
    slow = overview(10 * MAX_POINTS, "position", tube=True)
    fast = overview(10 * MAX_POINTS, "velocity")
    assert len(slow.times) == len(fast.times) == MAX_POINTS
    assert (slow.times[0], slow.times[-1], fast.times[-1]) == (0.0, 1.0, 1.0)
    assert np.array_equal(slow.times, slow.fmu)
    assert np.ptp(np.diff(fast.times)) < 1e-12
    assert fast.times[0] > 0.89


def test_closed_forms_hold_for_equal_frequencies_only() -> None:
    with pytest.raises(ValueError, match=r"frequency_ratio = 3.0"):
        _ = SteadyReferences(Device(), 0.0, 0.0, frequency_ratio=3.0).of_paper


@pytest.mark.parametrize("ratio", [1.02, 2.98])
def test_the_difference_frequency_counts_from_the_nearest_multiple(ratio: float) -> None:
    references = SteadyReferences(Device(), 0.0, 0.0, frequency_ratio=ratio)
    assert references.difference_frequency == pytest.approx(11.1408460, rel=1e-7)
