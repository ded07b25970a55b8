"""Averaged against resolved motion of the built FMU at odd frequency ratios, Coulomb friction."""

from __future__ import annotations

import math

import pytest

from tests.fmu.host import Instantiate
from tests.problems import STEADY_VELOCITIES

PERIOD = math.tau / 3500.0
FAST = 0.2366097
"""v_q of table 1, m/s."""
SCALE = 2.0 / 11.0
"""x0 w0 of table 1, m/s."""
START = 0.1 * 1e-4 * 3500.0 / 1.1
"""Slow velocity of table 1 from rest: the momentum that the drive leaves between its swings."""


@pytest.mark.parametrize(("ratio", "phase"), STEADY_VELOCITIES)
def test_steady_velocities(instantiate: Instantiate, ratio: int, phase: float) -> None:
    """Started where averages settle, the resolved motion forgets the rest of their error."""
    inputs = {"frequency_ratio": ratio, "phase": phase}
    theory = instantiate().initialize(**inputs).get("steady_velocity")[0]
    ends = []
    for fidelity in (0, 2):
        instance = instantiate().initialize(
            **inputs, fidelity=fidelity, initial_velocity=theory - START
        )
        instance.step(4000.0 * PERIOD)
        ends.append(instance.get("mean_velocity")[0])
    assert ends[0] == pytest.approx(theory, abs=1e-8), "averaged motion rests there"
    exact = STEADY_VELOCITIES[ratio, phase] * SCALE
    assert ends[1] == pytest.approx(exact, abs=2e-4 * SCALE), "resolved motion: the exact mean"
    assert ends[0] == pytest.approx(ends[1], abs=0.01 * FAST), "1 % of v_q"
