"""Motion averaged to first order before a step: its outputs are those at its start."""

from __future__ import annotations

import math
from collections.abc import Callable

import pytest

from tests.fmu.host import Instance
from tests.fmus import both_fmus

pytestmark = both_fmus


@pytest.mark.parametrize("law", [0, 1])
@pytest.mark.parametrize("initial", [{}, {"initial_velocity": 0.05}])
def test_outputs_before_the_first_step(
    instantiate: Callable[[], Instance], law: int, initial: dict[str, float]
) -> None:
    instance = instantiate().initialize(
        fidelity=0, averaging_order=1, friction_law=law, phase=0.4, **initial
    )
    names = ("mean_velocity", "friction_force", "stick_fraction")
    before = instance.get(*names)
    instance.step(1e-9)
    assert before == pytest.approx(instance.get(*names), rel=1e-6, abs=1e-8)
    assert before[0] == pytest.approx(
        0.1 * 1e-4 * 3500.0 / 1.1 + initial.get("initial_velocity", 0.0)
    )


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
