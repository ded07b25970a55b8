"""Averaged against resolved motion of the built FMU at odd frequency ratios, Coulomb friction."""

from __future__ import annotations

import math

import pytest

from tests.fmu.host import Instantiate

PERIOD = math.tau / 3500.0
FAST = 0.2366097
"""v_q of table 1, m/s."""
SCALE = 2.0 / 11.0
"""x0 w0 of table 1, m/s."""
START = 0.1 * 1e-4 * 3500.0 / 1.1
"""Slow velocity of table 1 from rest: the momentum that the drive leaves between its swings."""

EXACT = {
    (1, 0.0): 0.6966,
    (1, 1.5): 0.7719,
    (3, 0.0): -0.2780,
    (3, 1.5): 0.2036,
    (5, 0.0): -0.1169,
    (5, 1.5): -0.1795,
    (7, 0.0): 0.1297,
    (7, 1.5): -0.0600,
}
"""Steady velocity of the resolved device in x0 w0 by another program, by ratio and phase."""


@pytest.mark.parametrize(("ratio", "phase"), EXACT)
def test_from_rest_both_take_the_same_course(
    instantiate: Instantiate, ratio: int, phase: float
) -> None:
    slow, full = (
        instantiate().initialize(fidelity=fidelity, frequency_ratio=ratio, phase=phase)
        for fidelity in (0, 2)
    )
    for _ in range(6):
        for instance in (slow, full):
            instance.step(200.0 * PERIOD)
        one, other = slow.get("mean_velocity")[0], full.get("mean_velocity")[0]
        assert one == pytest.approx(other, abs=0.01 * FAST), f"1 % of v_q at t = {slow.time:.2f} s"


@pytest.mark.parametrize(("ratio", "phase"), EXACT)
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
    exact = EXACT[ratio, phase] * SCALE
    assert ends[1] == pytest.approx(exact, abs=2e-4 * SCALE), "resolved motion: the exact mean"
    assert ends[0] == pytest.approx(ends[1], abs=0.01 * FAST), "1 % of v_q"
