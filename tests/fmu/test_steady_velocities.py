"""Steady velocities of the built FMU against those that another program has found."""

from __future__ import annotations

import pytest

from tests.fmu.host import Instantiate
from tests.fmus import both_fmus

pytestmark = both_fmus

STEADY_VELOCITIES = {
    (1, 0.0): 0.6966,
    (1, 1.5): 0.7719,
    (3, 0.0): -0.2780,
    (3, 1.5): 0.2036,
    (5, 0.0): -0.1169,
    (5, 1.5): -0.1795,
    (7, 0.0): 0.1297,
    (7, 1.5): -0.0600,
}
"""Of resolved table 1 by frequency ratio and phase [rad], by another program, in units of x0 w0."""


@pytest.mark.parametrize(("ratio", "phase"), STEADY_VELOCITIES)
def test_steady_velocity_is_that_of_another_program(
    instantiate: Instantiate, ratio: int, phase: float
) -> None:
    scale = 2.0 / 11.0  # x0 w0 of table 1, m/s
    instance = instantiate().initialize(frequency_ratio=ratio, phase=phase)
    expected = STEADY_VELOCITIES[ratio, phase] * scale
    assert instance.get("steady_velocity") == pytest.approx((expected,), abs=2e-4 * scale)
