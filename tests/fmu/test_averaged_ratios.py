"""First-order averages against resolved motion of the FMU at and near odd frequency ratios."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import pytest

from slider_resonator.checks.measures import dominant_frequency
from slider_resonator.device.device import Device
from slider_resonator.references.averaged.averaged_coulomb import mean_friction, phase_to_force
from slider_resonator.references.closed_forms import equivalent_force
from tests.fmu.host import Instantiate
from tests.fmus import both_fmus
from tests.problems import STEADY_VELOCITIES

DRIVE = 3500.0 / math.tau
"""Drive frequency of table 1 in Hz."""
FAST = 0.2366097
"""v_q of table 1, m/s."""
SCALE = 2.0 / 11.0
"""x0 w0 of table 1, m/s."""
START = 0.1 * 1e-4 * 3500.0 / 1.1
"""Slow velocity of table 1 from rest: the momentum that the drive leaves between its swings."""


@pytest.mark.parametrize(("ratio", "phase"), STEADY_VELOCITIES)
def test_steady_velocities(instantiate: Instantiate, ratio: int, phase: float) -> None:
    """Started where averages settle, the resolved motion forgets the rest of their error."""
    inputs = {"frequency_ratio": ratio, "phase": phase, "averaging_order": 1}
    theory = instantiate().initialize(**inputs).get("steady_velocity")[0]
    ends = []
    for fidelity in (0, 2):
        instance = instantiate().initialize(
            **inputs, fidelity=fidelity, initial_velocity=theory - START
        )
        instance.step(4000.0 / DRIVE)
        ends.append(instance.get("mean_velocity")[0])
    assert ends[0] == pytest.approx(theory, abs=1e-8), "averaged motion rests there"
    exact = STEADY_VELOCITIES[ratio, phase] * SCALE
    assert ends[1] == pytest.approx(exact, abs=2e-4 * SCALE), "resolved motion: the exact mean"
    assert ends[0] == pytest.approx(ends[1], abs=0.01 * FAST), "1 % of v_q"


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
        averaging_order=1,
        frequency_ratio=nearest + detuning,
        initial_velocity=-START,
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


@pytest.mark.parametrize("nearest", [1, 3])
def test_the_slow_velocity_beats_near_a_ratio(instantiate: Instantiate, nearest: int) -> None:
    detunings = np.array([0.002, -0.005, 0.008, 0.016, 0.032])
    sizes = {}
    for fidelity in (0, 2):
        beats = [beat(instantiate, fidelity, nearest, detuning) for detuning in detunings]
        np.testing.assert_allclose(
            [found.frequency for found in beats],
            np.abs(detunings) * DRIVE,
            rtol=2e-3,
            err_msg="|ratio - n| w: the phase of the normal load turns once a beat",
        )
        sizes[fidelity] = np.array([found.amplitude for found in beats])
        assert all(np.diff(sizes[fidelity]) < 0.0), f"amplitudes {sizes} m/s"
        assert sizes[fidelity][-2] / sizes[fidelity][-1] == pytest.approx(2.0, rel=0.1), (
            "a slider too slow to follow swings in inverse proportion to the detuning"
        )
    np.testing.assert_allclose(sizes[0], sizes[2], rtol=0.0, atol=0.01 * FAST)


@both_fmus
@pytest.mark.parametrize(
    ("ratio", "amplitude", "phase"),
    [(2.0, 2.0, 1.0), (4.0, 3.0, 2.5), (-2.0, 2.54, -2.41), (6.0, 3.83, 2.5)],
)
def test_a_flat_balance_gives_the_highest_velocity(
    instantiate: Instantiate, ratio: float, amplitude: float, phase: float
) -> None:
    """In flight while sliding turns, friction balances the load over a range of velocities."""
    device = Device(normal_amplitude=amplitude)
    force = equivalent_force(device)
    lag = phase_to_force(force, phase, ratio)
    instance = instantiate().initialize(
        averaging_order=1, normal_amplitude=amplitude, frequency_ratio=ratio, phase=phase
    )
    velocity = instance.get("steady_velocity")[0] / force.velocity_amplitude
    assert velocity > 0.01
    for share, balanced in ((0.999, True), (-0.999, True), (1.001, False)):
        friction = mean_friction(share * velocity, 1.0, amplitude, lag, ratio)
        assert (abs(friction) < 1e-13) == balanced
