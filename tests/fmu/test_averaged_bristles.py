"""Averaged friction of bristles with next to no preload stays within its limit."""

from __future__ import annotations

import math
from collections.abc import Callable

import pytest

from tests.fmu.host import Instance
from tests.fmus import both_fmus

pytestmark = both_fmus


@pytest.mark.parametrize("preload", [0.0, 5e-324, 1e-17])
@pytest.mark.parametrize("ratio", [1.0, -1.0, 0.75, 100.0])
def test_friction_of_bristles_with_next_to_no_preload(
    instantiate: Callable[[], Instance], preload: float, ratio: float
) -> None:
    """The kinks of the load are then an exact half turn apart, and meet where sliding turns."""
    values = {
        "fidelity": 0,
        "averaging_order": 1,
        "friction_law": 1,
        "normal_amplitude": 1.0,
        "frequency_ratio": ratio,
    }
    for phase in (0.0, math.pi, -math.pi, math.pi / 2.0, 0.3):
        for velocity in (-0.144, -1.0, 0.2366097 - 0.0318182):
            instance = instantiate().initialize(
                normal_preload=preload, phase=phase, initial_velocity=velocity, **values
            )
            (force,) = instance.get("friction_force")
            assert abs(force) <= 2.0 * (0.1 + 10.0 * 0.5) / math.pi
