"""Averaged motion near a ratio, where the phase of the normal load drifts: right in any steps."""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import cache

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.averaged.averaged_motion import simulate_averaged
from tests.fmu.host import Instance
from tests.fmus import both_fmus

pytestmark = both_fmus

PERIOD = math.tau / 3500.0
FAST = 0.2366097
"""v_q of table 1, m/s."""


def velocities(
    instance: Instance,
    device: Mapping[str, float],
    inputs: Mapping[str, float],
    step: float,
    steps: int = 8,
) -> list[float]:
    """Slow velocity in m/s after each of some steps of this size in s."""
    instance.slave.reset()
    instance.time = 0.0
    instance.initialize(fidelity=0, averaging_order=1, **device, **inputs)
    found = []
    for _ in range(steps):
        instance.step(step)
        found.append(instance.get("mean_velocity")[0])
    return found


@cache
def reference(
    preload: float, amplitude: float, start: float, inputs: tuple[float, float], step: float
) -> list[float]:
    """The same by the reference, for 4 steps; `inputs` are frequency ratio and phase."""
    device = Device(
        fidelity=0,
        averaging_order=1,
        normal_preload=preload,
        normal_amplitude=amplitude,
        initial_velocity=start,
    )
    times = np.arange(1.0, 5.0, dtype=np.float64) * np.float64(step)
    held = HeldInputs(0.0, float(times[-1]), frequency_ratio=inputs[0], phase=inputs[1])
    return [float(v) for v in simulate_averaged(device, [held], times).mean_velocity]


def test_without_vibration_the_load_varies_too(instance: Instance) -> None:
    """A block that brakes under a load that stands still but for its own slow frequency."""
    device = {"base_amplitude": 0.0, "initial_velocity": 0.3, "normal_amplitude": 0.7}
    inputs = {"frequency_ratio": 0.002, "phase": 0.4}
    step = 60.0 * PERIOD
    found = velocities(instance, device, inputs, step)
    q = 0.002 * 3500.0

    def braked(time: float) -> float:
        impulse = time + 0.7 / q * (math.cos(0.4) - math.cos(q * time + 0.4))
        return max(0.0, 0.3 - 0.2 / 1.1 * impulse)

    expected = [braked(k * step) for k in range(1, 9)]
    assert found == pytest.approx(expected, abs=2e-6)


beats = st.builds(
    lambda fraction, share, sign: (fraction, sign * share * 0.1 / fraction[1] ** 2),
    st.sampled_from([(0, 1), (1, 1), (-1, 1), (2, 1), (3, 1), (1, 2), (2, 3), (3, 4)]),
    st.floats(0.05, 0.99),
    st.sampled_from([-1.0, 1.0]),
)


@settings(max_examples=8, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    beats,
    st.floats(-3.0, 3.0),
    st.sampled_from([(1.0, 1.0), (0.01, 0.01), (0.5, 1.0), (1e-9, 1.0), (1.0, 1.02)]),
    st.sampled_from([0.0, -0.144, 0.4]),
    st.sampled_from([0.125, 0.5, 1.0, 5.0, 10.0 / 3.0]),
)
def test_any_steps_near_any_ratio(
    instance: Instance,
    beat: tuple[tuple[int, int], float],
    phase: float,
    normal: tuple[float, float],
    velocity: float,
    step: float,
) -> None:
    (waves, turns), detuning = beat
    ratio, size = waves / turns + detuning, step * PERIOD / abs(detuning)
    device = {
        "normal_preload": normal[0],
        "normal_amplitude": normal[1],
        "initial_velocity": velocity,
    }
    found = velocities(instance, device, {"frequency_ratio": ratio, "phase": phase}, size, 4)
    expected = reference(*normal, velocity, (ratio, phase), size)
    assert found == pytest.approx(expected, abs=1e-6 * FAST)
