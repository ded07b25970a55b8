"""The mean power of friction over a drive period, and outputs of averaged motion at a change.

Scenes compare the power with force times velocity of the references.
"""

import math

import pytest

from tests.fmu.host import Instantiate
from tests.fmus import both_fmus

pytestmark = both_fmus

TURN = 2.0 * math.pi / 3500.0
AVERAGED = {"fidelity": 0, "averaging_order": 1}


def test_before_a_period_is_complete_it_is_the_mean_since_the_start(
    instantiate: Instantiate,
) -> None:
    instance = instantiate().initialize(initial_velocity=0.3)
    friction, velocity, power = instance.get("friction_force", "velocity", "friction_power")
    assert power == friction * velocity
    instance.step(0.3 * TURN)
    half = instance.get("friction_power")[0]
    instance.step(0.7 * TURN)
    whole = instance.get("friction_power")[0]
    assert 0.0 < half != whole > 0.0
    instance.step(0.4 * TURN)
    assert instance.get("friction_power") == (whole,), "then that of the last whole one"


def test_averaged_power_is_bounded_work_at_any_ratio(instantiate: Instantiate) -> None:
    """What a rapid normal load adds falls with the square of the ratio."""
    powers: list[float] = []
    for ratio in (999.0, 10001.0, 1e300):
        instance = instantiate().initialize(**AVERAGED, phase=0.7, frequency_ratio=ratio)
        instance.step(0.5 * TURN)
        powers += instance.get("friction_power")
    assert powers[0] == pytest.approx(powers[2], rel=1e-5)
    assert powers[1] == pytest.approx(powers[2], rel=1e-7)


def test_friction_follows_a_change_of_the_drive_at_once(instantiate: Instantiate) -> None:
    """The momentum stays, so that a smaller swing makes another slow velocity of it."""
    instance = instantiate().initialize(**AVERAGED, load=0.05)
    for _ in range(10):
        instance.step(100 * TURN)
    instance.set(amplitude_deviation=-0.5)
    at_once = instance.get("friction_force", "friction_power")
    instance.step(1e-9)
    assert at_once == pytest.approx(instance.get("friction_force", "friction_power"), rel=1e-8)


@pytest.mark.parametrize("amplitude", [0.0, 1e-9])
def test_a_slider_that_creeps_under_a_vibrating_load_is_in_the_error(
    instantiate: Instantiate, amplitude: float
) -> None:
    """Resolved, it creeps whenever friction falls below the load; averaged, it rests."""
    creeps = instantiate().initialize(base_amplitude=amplitude, load=0.19)
    rests = instantiate().initialize(**AVERAGED, base_amplitude=amplitude, load=0.19)
    for instance in (creeps, rests):
        instance.step(20 * TURN)
    (resolved,) = creeps.get("mean_velocity")
    averaged, error = rests.get("mean_velocity", "slow_motion_error")
    assert abs(resolved) > 2e-5
    assert abs(resolved - averaged) <= error <= 10.0 * abs(resolved - averaged)


def test_without_any_vibration_averages_have_no_error(instantiate: Instantiate) -> None:
    instance = instantiate().initialize(
        **AVERAGED, base_amplitude=0.0, normal_amplitude=0.0, load=0.19
    )
    instance.step(1.0)
    assert instance.get("slow_motion_error") == (0.0,)
