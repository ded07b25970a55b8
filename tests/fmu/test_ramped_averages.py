"""Averaged motion, fidelity 0, under inputs that vary linearly."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np
import pytest

from slider_resonator.arrays import Array
from tests.fmu.host import Instance, Instantiate
from tests.fmus import native_fmu_only

pytestmark = native_fmu_only

PERIOD = math.tau / 3500.0
FAST = 0.263
"""v_q of table 1 [m/s]."""

Piece = tuple[float, dict[str, float]]
"""Drive periods, and the derivatives of inputs in them."""

PHASE: list[Piece] = [(400, {"phase": 2.0})]
LOAD: list[Piece] = [(400, {"load": 0.12})]
BOTH_WAYS: list[Piece] = [(100, {"phase": 2.0}), (100, {}), (100, {"phase": -4.0, "load": 0.3}),
                          (100, {"load": -0.3})]  # fmt: skip


def run(instance: Instance, pieces: Sequence[Piece], steps: int) -> Array:
    """Mean velocity, position, centre and stated error after each step, so many in each piece."""
    inputs = dict(zip(("phase", "load", "frequency_ratio"), (0.0, 0.0, 1.0), strict=True))
    inputs["frequency_ratio"] = instance.get("frequency_ratio")[0]
    rows = []
    for periods, rates in pieces:
        size = periods * PERIOD / steps
        for _ in range(steps):
            instance.set(**inputs)
            if rates:
                instance.ramp(**rates)
            instance.step(size)
            inputs |= {name: inputs[name] + rate * size for name, rate in rates.items()}
            position, displacement = instance.get("position", "resonator_displacement")
            mean, stated = instance.get("mean_velocity", "slow_motion_error")
            rows.append((mean, position, position + displacement / 11.0, stated))
    return np.array(rows)


def compared(
    instantiate: Instantiate, pieces: Sequence[Piece], start: Mapping[str, float], order: int
) -> tuple[Array, float]:
    """Deviation from resolved motion, and the largest error that the FMU states."""
    resolved = run(instantiate().initialize(**start, fidelity=2), pieces, 10)
    averaged = instantiate().initialize(**start, fidelity=0, averaging_order=order)
    found = run(averaged, pieces, 10)
    return np.abs(found - resolved), float(found[:, 3].max())


@pytest.mark.parametrize("law", [0, 1])
@pytest.mark.parametrize("pieces", [PHASE, LOAD, BOTH_WAYS], ids=["phase", "load", "both ways"])
def test_first_order_keeps_the_error_it_states(
    instantiate: Instantiate, pieces: list[Piece], law: int
) -> None:
    deviation, stated = compared(instantiate, pieces, {"friction_law": law}, 1)
    # A mean over one of the first periods has the resonator's first swing in it.
    assert deviation[5:, 0].max() <= stated


@pytest.mark.parametrize("law", [0, 1])
def test_steps_do_not_matter(instantiate: Instantiate, law: int) -> None:
    """One slow phase after the other: from ratio 1 to 1.4, and a load and a phase that grow."""
    rates = {"phase": 1.0, "load": 0.05, "frequency_ratio": 2.0}
    ends = []
    for steps in (1, 3, 40):
        start = {"fidelity": 0, "averaging_order": 1, "friction_law": law}
        instance = instantiate().initialize(**start)
        ends.append(run(instance, [(0.2 / PERIOD, rates)], steps)[-1])
    assert ends[1][2] == pytest.approx(ends[0][2], abs=2e-10)
    assert ends[2][2] == pytest.approx(ends[0][2], abs=2e-10)


@pytest.mark.parametrize("velocity", [0.375, 0.44])
@pytest.mark.parametrize("law", [0, 1])
@pytest.mark.parametrize("ratio", [1.0, 0.0])
def test_a_dip_below_the_fast_velocity_is_not_missed(
    instantiate: Instantiate, ratio: float, law: int, velocity: float
) -> None:
    """Constant friction beyond v_q lets steps grow; the load turns it at 0.193 or 0.258 m/s."""
    start = {"frequency_ratio": ratio, "averaging_order": 1, "friction_law": law}
    ends = []
    for steps in (1, 2, 64):
        instance = instantiate().initialize(**start, fidelity=0, initial_velocity=velocity)
        found = run(instance, [(8.0 / PERIOD, {"load": -0.1})], steps)
        ends.append(found[-1, 0])
    assert ends[:2] == pytest.approx(ends[2:] * 2, abs=1e-8)


def test_a_load_that_grows_beyond_friction_is_followed_in_one_step(
    instantiate: Instantiate,
) -> None:
    """The slow velocity gets to -v_q slowly: there friction ceases to depend on it."""
    start = {"normal_amplitude": 0.0, "friction_coefficient": 1.0}
    ends = []
    for steps in (1, 64):
        instance = instantiate().initialize(**start, fidelity=0, averaging_order=1)
        ends.append(run(instance, [(6.0 / PERIOD, {"load": 2.2 / 6.0})], steps)[-1, 0])
    assert ends[0] == pytest.approx(ends[1], abs=1e-8)
    assert ends[0] < -FAST


@pytest.mark.parametrize("duration", [0.2, 40.0])
@pytest.mark.parametrize("ratio", [0.0, 0.97, 1.0])
@pytest.mark.parametrize("law", [0, 1])
def test_the_frequency_of_a_constant_load_does_not_matter(
    instantiate: Instantiate, law: int, ratio: float, duration: float
) -> None:
    start = {"normal_amplitude": 0.0, "initial_velocity": 0.2, "friction_law": law}
    ends = []
    for rate in (0.0, 5.0):
        instance = instantiate().initialize(
            **start, fidelity=0, averaging_order=1, frequency_ratio=ratio
        )
        instance.ramp(frequency_ratio=rate)
        instance.step(duration)
        ends.append(instance.get("mean_velocity", "position"))
    assert ends[1] == pytest.approx(ends[0], abs=2e-9)


@pytest.mark.parametrize(
    ("load", "rate", "friction"), [(0.0, 0.12, 0.2), (0.5, -1.0, 0.2), (-0.5, 0.7, 0.2)]
)
def test_a_block_without_vibration_is_exact(
    instantiate: Instantiate, load: float, rate: float, friction: float
) -> None:
    """Without drive it sticks, is released and stops as the resolved block of one mass."""
    block = {"base_amplitude": 0.0, "normal_amplitude": 0.0, "resonator_mass": 0.0, "load": load}
    ends = []
    for fidelity in (0, 2):
        instance = instantiate().initialize(**block, fidelity=fidelity)
        for k in range(4):
            instance.set(load=load + 0.5 * k * rate)
            instance.ramp(load=rate)
            instance.step(0.5)
        ends.append(instance.get("position", "velocity"))
    assert ends[0] == pytest.approx(ends[1], rel=1e-11, abs=1e-15)
    assert friction == 2.0 * 0.1 * 1.0
