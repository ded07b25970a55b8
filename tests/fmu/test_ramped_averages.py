"""Averaged motion, fidelity 0, under inputs that vary linearly."""

from __future__ import annotations

import math
from collections.abc import Sequence

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


def run(instance: Instance, pieces: Sequence[Piece], steps: int) -> Array:
    """Mean velocity, position and centre after each step, so many in each piece."""
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
            (mean,) = instance.get("mean_velocity")
            rows.append((mean, position, position + displacement / 11.0))
    return np.array(rows)


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
