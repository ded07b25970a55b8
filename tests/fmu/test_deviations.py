"""Deviations of the drive from its parameters: under inputs that grow, and refused ones.

Scenes judge motion under deviations that are held.
"""

from collections.abc import Mapping

import pytest

from tests.fmu.host import OUTPUTS, Instance, Instantiate
from tests.fmus import both_fmus, native_fmu_only

DEVICE = {"tangential_force": 20.0, "phase": 0.4, "load": 0.02}
MOTIONS = [{"fidelity": n} for n in (2, 1)]
MOTIONS += [{"fidelity": 0, "averaging_order": order} for order in (1, 2)]


def tuned(amplitude: float, frequency: float) -> Mapping[str, float]:
    """The parameters of a drive with these deviations."""
    return {
        "base_amplitude": 1e-4 * (1.0 + amplitude),
        "tangential_force": 20.0 * (1.0 + amplitude),
        "drive_frequency": 3500.0 * (1.0 + frequency),
    }


def deviating(amplitude: float, frequency: float) -> Mapping[str, float]:
    return {"amplitude_deviation": amplitude, "frequency_deviation": frequency}


@native_fmu_only
def test_ramped_inputs_of_a_drive_that_deviates(instantiate: Instantiate) -> None:
    for motion in MOTIONS:
        deviates, is_tuned = instantiate(), instantiate()
        deviates.initialize(**DEVICE, **motion, **deviating(0.2, 0.01))
        is_tuned.initialize(**{**DEVICE, **motion, **tuned(0.2, 0.01)})
        for instance in (deviates, is_tuned):
            instance.ramp(phase=2.0, load=0.3, frequency_ratio=0.1)
            instance.step(0.011)
        assert deviates.get(*OUTPUTS) == is_tuned.get(*OUTPUTS)


@both_fmus
def test_a_deviation_to_a_frequency_that_is_too_low_is_refused(instantiate: Instantiate) -> None:
    instance = instantiate().initialize(drive_frequency=2e-6)
    with instance.refuses(
        "frequency_deviation = -0.75 refused: it makes drive_frequency 5e-07", "at least 1e-06"
    ):
        instance.set(frequency_deviation=-0.75)


@native_fmu_only
@pytest.mark.parametrize("name", ["amplitude_deviation", "frequency_deviation"])
def test_deviations_are_held_over_a_step(instance: Instance, name: str) -> None:
    instance.ramp(**{name: 0.0})
    with instance.refuses(f"derivative of {name} = 0.5 refused", "held over a step", "must be 0"):
        instance.ramp(**{name: 0.5})
    instance.step(1e-3)
    assert instance.get(name) == (0.0,)
