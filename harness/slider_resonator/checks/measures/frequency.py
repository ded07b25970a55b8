"""The dominant frequency of a sampled signal, finer than the resolution of its spectrum."""

from __future__ import annotations

import numpy as np
import scipy

from slider_resonator.arrays import Array

HARMONICS = 3
"""Harmonics in the fit: without them a distorted wave would shift the frequency."""


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

    def misfit(frequency: float) -> float:
        basis = _basis(times - times.mean(), frequency)
        rest = np.linalg.lstsq(basis, signal, rcond=None)[1]
        return float(rest[0]) if rest.size else np.inf

    bounds = ((line - 1.0 + 1e-3) * resolution, (line + 1.0) * resolution)
    best = scipy.optimize.minimize_scalar(
        misfit, bounds=bounds, method="bounded", options={"xatol": 1e-10}
    )
    return float(best.x)


def _basis(times: Array, frequency: float) -> Array:
    """Return constant, trend and the waves of a frequency (Hz) at the times as columns."""
    columns = [np.ones_like(times), times / np.ptp(times)]
    nyquist = 0.5 * (len(times) - 1) / np.ptp(times)
    for harmonic in range(1, HARMONICS + 1):
        if harmonic > 1 and harmonic * frequency >= 0.9 * nyquist:
            break
        angle = 2.0 * np.pi * harmonic * frequency * times
        columns += [np.cos(angle), np.sin(angle)]
    return np.column_stack(columns)
