"""Motion averaged to first order before a step: its outputs are those at its start."""

from __future__ import annotations

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
