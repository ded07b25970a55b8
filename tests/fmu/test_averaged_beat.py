"""Frequencies near a ratio of 1 and of 3: the slow velocity of the built FMU swings to and fro."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import pytest

from slider_resonator.checks.measures.frequency import dominant_frequency
from tests.fmu.host import Instantiate

DRIVE = 3500.0 / math.tau
"""Drive frequency of table 1 in Hz."""
FAST = 0.2366097
"""v_q of table 1, m/s."""
FROM_REST_IN_THE_MEAN = -0.1 * 1e-4 * 3500.0 / 1.1
"""Initial velocity in m/s without slow momentum, so that little has to die out."""


@dataclass(frozen=True)
class Beat:
    frequency: float
    """Hz."""
    amplitude: float
    """Of the slow velocity, m/s."""


def beat(instantiate: Instantiate, fidelity: int, nearest: int, detuning: float) -> Beat:
    """The swing of the mean velocity over eight beats, once four have passed."""
    instance = instantiate().initialize(
        fidelity=fidelity,
        frequency_ratio=nearest + detuning,
        initial_velocity=FROM_REST_IN_THE_MEAN,
    )
    expected = 1.0 / (abs(detuning) * DRIVE)
    instance.step(max(4.0 * expected, 3.0))
    times, velocities = [], []
    for _ in range(8 * 24):
        instance.step(expected / 24.0)
        times.append(instance.time)
        velocities.append(instance.get("mean_velocity")[0])
    record = np.array(velocities)
    return Beat(dominant_frequency(np.array(times), record), 0.5 * float(np.ptp(record)))


@pytest.mark.parametrize("detuning", [0.002, -0.005, 0.02])
@pytest.mark.parametrize("nearest", [1, 3])
def test_the_beat_is_at_the_difference_frequency(
    instantiate: Instantiate, nearest: int, detuning: float
) -> None:
    averaged, resolved = (beat(instantiate, fidelity, nearest, detuning) for fidelity in (0, 2))
    for found in (averaged, resolved):
        assert found.frequency == pytest.approx(abs(detuning) * DRIVE, rel=2e-3), (
            "|ratio - n| w: the phase of the normal load turns once a beat"
        )
    assert averaged.amplitude == pytest.approx(resolved.amplitude, abs=0.01 * FAST), "1 % of v_q"


@pytest.mark.parametrize("fidelity", [0, 2])
@pytest.mark.parametrize("nearest", [1, 3])
def test_the_beat_gets_smaller_with_detuning(
    instantiate: Instantiate, nearest: int, fidelity: int
) -> None:
    sizes = [
        beat(instantiate, fidelity, nearest, detuning).amplitude
        for detuning in (0.002, 0.008, 0.016, 0.032)
    ]
    assert all(np.diff(sizes) < 0.0), f"amplitudes {sizes} m/s"
    assert sizes[2] / sizes[3] == pytest.approx(2.0, rel=0.1), (
        "a slider too slow to follow swings in inverse proportion to the detuning"
    )
