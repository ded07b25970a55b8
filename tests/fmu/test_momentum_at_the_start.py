"""The start of `fidelity` 1: the momentum of the full device, so that slow motion is right."""

from __future__ import annotations

import math

import pytest

from tests.fmu.host import Instance, Instantiate
from tests.fmus import both_fmus

pytestmark = both_fmus

PERIOD = math.tau / 3500.0
RINGING = 20
"""Drive periods that the resonator of the full device takes from rest to its steady vibration."""


def mean_velocities(instance: Instance) -> list[float]:
    """Mean velocity in m/s of some drive periods from rest up to the steady motion."""
    found = []
    for periods in (RINGING, 30, 50, 100, 200, 400, 700, 1500):
        instance.run(periods, PERIOD)
        found.append(instance.get("mean_velocity")[0])
    return found


@pytest.mark.slow
@pytest.mark.parametrize("law", [0, 1])
def test_mean_velocity_from_rest_is_that_of_the_full_device(
    instantiate: Instantiate, law: int
) -> None:
    slider, full = (
        mean_velocities(instantiate().initialize(fidelity=fidelity, friction_law=law))
        for fidelity in (1, 2)
    )
    peak = max(map(abs, full))
    assert slider == pytest.approx(full, abs=0.01 * peak)


def test_momentum_is_that_of_the_initial_values(instantiate: Instantiate) -> None:
    initial = {"initial_velocity": 0.3, "initial_resonator_velocity": -1.7}
    instance = instantiate().initialize(fidelity=1, resonator_mass=0.25, **initial)
    velocity, rate = instance.get("velocity", "resonator_velocity")
    assert 1.25 * velocity + 0.25 * rate == pytest.approx(1.25 * 0.3 - 0.25 * 1.7, rel=1e-13)
