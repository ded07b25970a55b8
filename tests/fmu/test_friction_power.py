"""The mean power of friction over a drive period, at its start and in long steps.

Scenes compare it with force times velocity of the references.
"""

import math

import pytest

from tests.fmu.host import Instantiate
from tests.fmus import both_fmus

pytestmark = both_fmus

TURN = 2.0 * math.pi / 3500.0


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


@pytest.mark.parametrize("law", [0, 1])
@pytest.mark.parametrize("last", [0.3, 2.9, 40.2])
def test_long_steps_give_the_power_of_short_ones(
    instantiate: Instantiate, last: float, law: int
) -> None:
    """Work counts near the end of a step alone, wherever the step began and ends."""
    powers = []
    for steps in ([30.4, last], [0.38] * 80 + [last / 8] * 8):
        instance = instantiate().initialize(friction_law=law, phase=0.4)
        for size in steps:
            instance.step(size * TURN)
        powers.append(instance.get("friction_power")[0])
    assert powers[0] == pytest.approx(powers[1], rel=1e-12 if law == 0 else 1e-6)


def test_averaged_power_is_bounded_work_at_any_ratio(instantiate: Instantiate) -> None:
    """What a rapid normal load adds falls with the square of the ratio."""
    powers = []
    for ratio in (999.0, 10001.0, 1e300):
        values = {"fidelity": 0, "averaging_order": 1, "phase": 0.7, "frequency_ratio": ratio}
        instance = instantiate().initialize(**values)
        instance.step(0.5 * TURN)
        powers += instance.get("friction_power")
    assert powers[0] == pytest.approx(powers[2], rel=1e-5)
    assert powers[1] == pytest.approx(powers[2], rel=1e-7)
