"""Measures of sampled signals: deviation, tubes, slow displacement, ripple, dominant frequency."""

from dataclasses import dataclass

import numpy as np
import scipy

from slider_resonator.arrays import Array


def peak(signal: Array) -> float:
    """Return the largest magnitude of a signal (n,), NaN when there is one in it."""
    return float(np.abs(signal).max())


def share_of(difference: float, size: float) -> float:
    """Return a difference as a share of a size: 0 of nothing is 0, anything else is infinite."""
    if difference == 0.0:
        return 0.0
    return difference / size if size > 0.0 else float("inf")


@dataclass(frozen=True)
class Tube:
    """A reference signal `middle` and its `lower` and `upper` bounds, all shape (n,)."""

    middle: Array
    lower: Array
    upper: Array

    def outside(self, signal: Array) -> Array:
        """Return the distance of a signal (n,) from the tube at each point, NaN where it is NaN."""
        return np.maximum(0.0, np.maximum(self.lower - signal, signal - self.upper))


def slow_displacement(times: Array, position: Array, period: float) -> Array:
    """Return the position averaged over the drive period (s) that ends at each time, shape (m,).

    The m results belong to the times from the end of the first period on. With equal steps that
    divide the period the ripple vanishes from it exactly. Raises ValueError for a record shorter
    than a period.
    """
    starts = times - period
    first = int(np.searchsorted(starts, times[0] - 1e-9 * period))
    if first == len(times):
        raise ValueError(
            f"a record of {times[-1] - times[0]:.6g} s is shorter than the period {period:.6g} s"
        )
    pieces = 0.5 * (position[1:] + position[:-1]) * np.diff(times)
    integral = np.concatenate([[0.0], np.cumsum(pieces)])
    return np.asarray((integral[first:] - np.interp(starts[first:], times, integral)) / period)


POINTS_PER_PERIOD = 8
PERIODS = 4
"""The last drive periods of a record, to which the ripple is fitted."""


def ripple_amplitude(times: Array, position: Array, period: float) -> float:
    """Return the amplitude of the component at the drive frequency, in the unit of the position.

    It is fitted, together with a straight line, to the last `PERIODS` drive periods of the record,
    `period` (s) each. Raises ValueError for a record that is shorter or has fewer than 8 points per
    period.
    """
    window = times >= times[-1] - PERIODS * period * (1.0 + 1e-9)
    if times[-1] - times[0] < PERIODS * period * (1.0 - 1e-9):
        raise ValueError(f"the ripple needs a record of at least {PERIODS} drive periods")
    if window.sum() < PERIODS * POINTS_PER_PERIOD:
        raise ValueError(
            f"the ripple needs at least {POINTS_PER_PERIOD} points per drive period, "
            f"the record has {window.sum() / PERIODS:.1f}"
        )
    time = (times[window] - times[-1]) / period
    angle = 2.0 * np.pi * time
    basis = np.column_stack([np.ones_like(time), time, np.cos(angle), np.sin(angle)])
    coefficients = np.linalg.lstsq(basis, position[window], rcond=None)[0]
    return float(np.hypot(coefficients[2], coefficients[3]))


class NoOscillation(ValueError):
    """A signal that is constant or not finite, and has no frequency."""


def dominant_frequency(times: Array, signal: Array) -> float:
    """Return the frequency (Hz) of the strongest oscillation around the trend of a signal (n,).

    The highest line of a windowed spectrum starts a least squares fit of a wave with harmonics and
    a straight trend. Raises ValueError for unequal steps and for fewer than 16 points, and
    NoOscillation for a signal that is constant or not finite.
    """
    steps = np.diff(times)
    if len(times) < 16 or np.ptp(steps) > 1e-6 * steps.mean():
        raise ValueError("the dominant frequency needs at least 16 points at equal steps")
    if not np.isfinite(signal).all():
        raise NoOscillation("the signal is not finite")
    trend = np.polynomial.Polynomial.fit(times, signal, 1)
    flat = signal - trend(times)
    if float(np.abs(flat).max()) <= 1e-12 * float(np.abs(signal).max()):
        raise NoOscillation("the signal does not oscillate")
    spectrum = np.abs(np.fft.rfft(flat * np.hanning(len(flat))))
    resolution = 1.0 / (len(flat) * float(steps.mean()))
    line = max(int(np.argmax(spectrum)), 1)
    bounds = ((line - 1.0 + 1e-3) * resolution, (line + 1.0) * resolution)
    local = times - times.mean()
    nyquist = 0.5 * (len(times) - 1) / np.ptp(times)

    def misfit(at: Array) -> Array:
        """Return what constant, trend and the waves of a frequency (Hz) leave of the signal."""
        columns = [np.ones_like(local), local / np.ptp(local)]
        for harmonic in (1, 2, 3):  # without these a distorted wave would shift the frequency
            if harmonic == 1 or harmonic * at[0] < 0.9 * nyquist:
                angle = 2.0 * np.pi * harmonic * at[0] * local
                columns += [np.cos(angle), np.sin(angle)]
        basis = np.column_stack(columns)
        waves = np.linalg.lstsq(basis, signal, rcond=None)[0]
        return np.asarray(basis @ waves - signal)

    found = scipy.optimize.least_squares(
        misfit, line * resolution, bounds=bounds, x_scale=resolution, xtol=1e-12, gtol=1e-15
    )
    return float(found.x[0])
