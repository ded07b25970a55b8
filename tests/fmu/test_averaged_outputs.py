"""Outputs of averaged motion where the drive has just changed, or hardly vibrates."""

import pytest

from tests.fmu.host import Instantiate
from tests.fmus import both_fmus

PERIOD = 1.795195802e-3  # of the drive of table 1, s
AVERAGED = {"fidelity": 0, "averaging_order": 1}


@both_fmus
def test_friction_follows_a_change_of_the_drive_at_once(instantiate: Instantiate) -> None:
    """The momentum stays, so that a smaller swing makes another slow velocity of it."""
    instance = instantiate().initialize(**AVERAGED, load=0.05)
    for _ in range(10):
        instance.step(100 * PERIOD)
    instance.set(amplitude_deviation=-0.5)
    at_once = instance.get("friction_force", "friction_power")
    instance.step(1e-9)
    assert at_once == pytest.approx(instance.get("friction_force", "friction_power"), rel=1e-8)


@both_fmus
@pytest.mark.parametrize("amplitude", [0.0, 1e-9])
def test_a_slider_that_creeps_under_a_vibrating_load_is_in_the_error(
    instantiate: Instantiate, amplitude: float
) -> None:
    """Resolved, it creeps whenever friction falls below the load; averaged, it rests."""
    creeps = instantiate().initialize(base_amplitude=amplitude, load=0.19)
    rests = instantiate().initialize(**AVERAGED, base_amplitude=amplitude, load=0.19)
    for instance in (creeps, rests):
        instance.step(20 * PERIOD)
    (resolved,) = creeps.get("mean_velocity")
    averaged, error = rests.get("mean_velocity", "slow_motion_error")
    assert abs(resolved) > 2e-5
    assert abs(resolved - averaged) <= error <= 10.0 * abs(resolved - averaged)


@both_fmus
def test_without_any_vibration_averages_have_no_error(instantiate: Instantiate) -> None:
    instance = instantiate().initialize(
        **AVERAGED, base_amplitude=0.0, normal_amplitude=0.0, load=0.19
    )
    instance.step(1.0)
    assert instance.get("slow_motion_error") == (0.0,)
