"""A resonator without mass does nothing to the slider, and must still swing itself."""

from __future__ import annotations

import pytest

from tests.fmu.host import Instantiate
from tests.fmus import both_fmus

pytestmark = both_fmus

SIGNALS = ("resonator_displacement", "resonator_velocity")


@pytest.mark.parametrize("initial_velocity", [0.0, 0.1])
def test_it_swings_with_lugre_as_with_coulomb_friction(
    instantiate: Instantiate, initial_velocity: float
) -> None:
    rows = []
    for law in (0, 1):
        instance = instantiate().initialize(
            resonator_mass=0.0,
            friction_law=law,
            initial_velocity=initial_velocity,
            bristle_stiffness=1e8,
        )
        swings = []
        for _ in range(40):
            instance.step(1e-4)
            swings.append(instance.get(*SIGNALS))
        rows.append(swings)
    peak = max(abs(displacement) for displacement, _ in rows[0])
    assert peak > 1e-4, "the base drives it at resonance"
    for (coulomb, coulomb_rate), (lugre, lugre_rate) in zip(*rows, strict=True):
        assert lugre == pytest.approx(coulomb, abs=1e-3 * peak), "only friction differs"
        assert lugre_rate == pytest.approx(coulomb_rate, abs=1e-3 * 3500.0 * peak)
