"""Reversals after a velocity that stays next to zero for long, against the Taylor reference."""

import numpy as np
import pytest

from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.resolved.simulate import simulate
from tests.fmu.host import Instantiate
from tests.fmus import native_fmu_only

pytestmark = native_fmu_only

RELEASED_BY_A_RAMP = {
    "resonator_mass": 2.3,
    "resonator_frequency": 1e4,
    "drive_frequency": 19000.0,
    "damping_ratio": 0.022,
}
RELEASED_BY_THE_DRIVE = {
    "slider_mass": 12.3,
    "resonator_mass": 9.66,
    "resonator_frequency": 494.0,
    "damping_ratio": 0.001,
    "normal_preload": 0.7,
    "normal_amplitude": 0.35,
    "base_amplitude": 7.06e-5,
    "drive_frequency": 631.7,
    "tangential_force": -9.04,
    "friction_coefficient": 0.435,
    "friction_faces": 1,
}


@pytest.mark.parametrize(
    ("device", "held"),
    [
        (RELEASED_BY_A_RAMP, HeldInputs(0.0, 1.75e-3, load_rate=1.9e6)),
        (RELEASED_BY_THE_DRIVE, HeldInputs(0.0, 0.08, 2.693, -1.25, frequency_ratio=0.0)),
    ],
    ids=["ramp", "drive"],
)
def test_the_first_reversal_is_located(
    instantiate: Instantiate, device: dict[str, float], held: HeldInputs
) -> None:
    """Next to zero the search takes lengthened steps: one passes the reversal."""
    reference = simulate(Device.from_mapping(device), [held], np.array([held.stop]))
    inputs = {name: getattr(held, name) for name in ("phase", "load", "frequency_ratio")}
    instance = instantiate().initialize(**device, **inputs)
    if held.vary:
        instance.ramp(load=held.load_rate)
    # The event after the release.
    instance.step(1.01 * reference.event_times[1])
    (located,) = instance.get("last_event_time")
    assert located == pytest.approx(reference.event_times[1], rel=1e-9)
    instance.step(held.stop - instance.time)
    velocity, reversals = instance.get("velocity", "reversals")
    assert velocity == pytest.approx(reference.velocity[-1], rel=1e-12)
    assert reversals == reference.reversals
