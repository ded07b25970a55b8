"""Closed forms against the matrix exponential of the same system, at the hard spots too."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.linalg import expm

from fmu_src.python.slider_component.forced_oscillator import ForcedOscillator
from fmu_src.python.slider_component.oscillator import (
    Oscillator,
    double_integral,
    integral,
    resonates,
    step_response,
)

DAMPING = [0.0, 1e-12, 0.05, 0.5, 0.9, 1.0 - 1e-12, 1.0, 1.0 + 1e-12, 1.7, 100.0]


def exact(
    oscillator: Oscillator,
    constant: float,
    forcing: tuple[tuple[float, complex], ...],
    y0: float,
    u0: float,
    t: float,
) -> tuple[float, float]:
    """Displacement and rate by the matrix exponential, forcing as states of the system."""
    size = 3 + 2 * len(forcing)
    matrix = np.zeros((size, size))
    matrix[0, 1] = 1.0
    matrix[1, :3] = -oscillator.stiffness, -2.0 * oscillator.decay, 1.0
    start = np.array([y0, u0, constant] + [0.0] * (size - 3))
    for i, (frequency, amplitude) in enumerate(forcing):
        real, imag = 3 + 2 * i, 4 + 2 * i
        matrix[1, real] = 1.0
        matrix[real, imag] = -frequency
        matrix[imag, real] = frequency
        start[real], start[imag] = amplitude.real, amplitude.imag
    end = expm(matrix * t) @ start
    return float(end[0]), float(end[1])


@pytest.mark.parametrize("damping", DAMPING)
@pytest.mark.parametrize(
    "frequency", [3.0, 3.0 * (1 + 1e-9), 3.0 * (1 + 0.02), -3.0, 0.0, 1e-6, 40.0]
)
@pytest.mark.parametrize("t", [0.0, 1e-9, 1e-6, 0.3, 4.0])
def test_forced_from_any_state(damping: float, frequency: float, t: float) -> None:
    """Undamped resonance, where the response grows with t, included."""
    oscillator = Oscillator(damping * 3.0, 9.0)
    forcing = ((frequency, 2.0 - 1.0j), (1.1, 0.4j))
    sample = ForcedOscillator(oscillator, 0.3, forcing, 0.2, -0.5, 40.0).sample(t)
    y, u = exact(oscillator, 0.3, forcing, 0.2, -0.5, t)
    scale = 1.0 + abs(y) + abs(u)
    assert sample.displacement == pytest.approx(y, abs=2e-13 * scale)
    assert sample.rate == pytest.approx(u, abs=2e-12 * scale)
    expected = 0.3 - 2.0 * oscillator.decay * u - 9.0 * y
    expected += sum((a * complex(math.cos(f * t), math.sin(f * t))).real for f, a in forcing)
    assert sample.acceleration == pytest.approx(expected, abs=1e-10 * scale * (1 + damping))


@given(
    damping=st.sampled_from(DAMPING),
    frequency=st.floats(-10.0, 10.0),
    y0=st.floats(-1.0, 1.0),
    u0=st.floats(-1.0, 1.0),
    t=st.floats(0.0, 5.0),
)
def test_bounds_hold_ahead(
    damping: float, frequency: float, y0: float, u0: float, t: float
) -> None:
    oscillator = Oscillator(damping * 3.0, 9.0)
    motion = ForcedOscillator(oscillator, 0.1, ((frequency, 1.0 + 0.5j),), y0, u0, 10.0)
    here = motion.sample(t)
    step = min(motion.horizon, 1.0) / 16
    samples = [motion.sample(t + i * step) for i in range(17)]
    for sample in samples:
        assert abs(sample.acceleration) <= here.acceleration_bound * (1 + 1e-9) + 1e-9
    for one, other in itertools.pairwise(samples):
        jerk = abs(other.acceleration - one.acceleration) / step
        assert jerk <= here.jerk_bound * (1 + 1e-6) + 1e-6, "the jerk bound does not hold"


def test_resonance_is_seen_from_either_direction() -> None:
    undamped = Oscillator(0.0, 9.0)
    assert resonates(undamped, 3.0)
    assert resonates(undamped, -3.0)
    assert not resonates(undamped, 3.2)
    assert not resonates(Oscillator(3.0, 9.0), 3.0), (
        "a critically damped oscillator never resonates"
    )


@pytest.mark.parametrize("frequency", [0.0, 1e-9, 0.3, -2.0, 50.0])
@pytest.mark.parametrize("t", [1e-6, 0.2, 3.0])
def test_integrals(frequency: float, t: float) -> None:
    s, weights = np.polynomial.legendre.leggauss(200)
    s, weights = 0.5 * t * (s + 1.0), 0.5 * t * weights
    wave = np.exp(1j * frequency * s)
    assert integral(frequency, t) == pytest.approx(complex(weights @ wave), rel=1e-13)
    expected = complex(weights @ ((t - s) * wave))
    assert double_integral(frequency, t) == pytest.approx(expected, rel=1e-13)


@pytest.mark.parametrize("damping", [0.0, 0.05, 1.0, 1.5])
@pytest.mark.parametrize("frequency", [1e-9, 1e-5, 1e-2, 0.5])
@pytest.mark.parametrize("t", [1e-3, 0.2, 3.0])
def test_soft_oscillators_keep_their_digits(damping: float, frequency: float, t: float) -> None:
    """Forced by a constant, at rest before: u = S exactly, and y near t^2 / 2 while w t << 1."""
    oscillator = Oscillator(damping * frequency, frequency * frequency)
    displacement, velocity = step_response(oscillator, t)
    y, u = exact(oscillator, 1.0, (), 0.0, 0.0, t)
    assert displacement == pytest.approx(y, rel=3e-13)
    assert velocity == pytest.approx(u, rel=3e-13)


@pytest.mark.parametrize("damping", [0.0, 0.05, 1.5])
def test_slow_forcing_of_a_soft_oscillator(damping: float) -> None:
    oscillator = Oscillator(damping * 1e-3, 1e-6)
    forcing = ((1e-3, 2.0 - 1.0j), (-2e-4, 0.4j), (7.0, 0.3 + 0j))
    for t in (1e-3, 0.4, 5.0):
        sample = ForcedOscillator(oscillator, 0.3, forcing, 0.2, -0.5, 7.0).sample(t)
        y, u = exact(oscillator, 0.3, forcing, 0.2, -0.5, t)
        assert sample.displacement == pytest.approx(y, rel=1e-12, abs=1e-13)
        assert sample.rate == pytest.approx(u, rel=1e-12, abs=1e-13)
