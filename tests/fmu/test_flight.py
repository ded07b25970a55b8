"""Turning in the air is no reversal: sliding begins at touchdown."""

import pytest

from tests.fmu.host import Instantiate
from tests.fmus import both_fmus

DEVICE = {
    "tangential_force": 2000.0,
    "base_amplitude": 0.0,
    "resonator_mass": 0.0,
    "normal_amplitude": 3.0,
    "frequency_ratio": 0.05,  # the contact is open for some periods of the drive
    "bristle_damping": 0.0,
}
PERIODS = 40 * 1.795195802e-3  # s


@both_fmus
def test_turns_in_flight_are_no_reversals(instantiate: Instantiate) -> None:
    """Hard bristles give Coulomb friction, and bend in flight, too, whenever the slider turns."""
    found = []
    for law in (0, 1):
        instance = instantiate().initialize(**DEVICE, friction_law=law, bristle_stiffness=1e7)
        instance.step(PERIODS)
        found.append(instance.get("reversals", "last_event_time"))
    coulomb, lugre = found
    assert lugre == pytest.approx(coulomb, rel=1e-6)
    assert coulomb[0] == 51.0, "79 with the turns in flight"
