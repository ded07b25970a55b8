"""The mean power of friction over a drive period, which scenes compare with references as well."""

import math
import tomllib
from pathlib import Path

import pytest

from slider_resonator.checks.validate import validate
from slider_resonator.scenes.scene import scene_from
from tests.fmu.host import Instantiate
from tests.fmus import both_fmus

pytestmark = both_fmus

TURN = 2.0 * math.pi / 3500.0

BUNDLES = ("heat", "heat_on_bristles")
"""Expectations by friction law."""

CASES = {
    "under a load": "inputs = { phase = 0.7, load = 0.05 }",
    "normal load backwards": "inputs = { frequency_ratio = -1.0, phase = 1.0 }",
    "constant normal load": "inputs = { frequency_ratio = 0.0, phase = 0.5 }",
    "normal load that creeps": "inputs = { frequency_ratio = 0.01, phase = 0.5 }",
    "a beat": "inputs.frequency_ratio = 1.0001",
    "stick and slip": "device = { friction_coefficient = 4.0, base_amplitude = 2e-5 }",
    "undamped resonance": "device = { damping_ratio = 0.0, resonator_frequency = 3337.0 }",
    "more drive": "inputs.amplitude_deviation = 0.2\ndevice.tangential_force = 200.0",
    "hard bristles": "device = { friction_law = 1, bristle_stiffness = 1e6 }",
    "soft bristles": "device = { friction_law = 1, bristle_stiffness = 1e3 }",
    "flight on bristles": "inputs.frequency_ratio = 0.5\n"
    "device = { friction_law = 1, normal_amplitude = 1.5 }",
}
"""Devices and inputs under which no scene expects these, as scene files state them."""


@pytest.mark.parametrize("case", CASES)
def test_heat_is_force_times_velocity_of_the_reference(fmu: Path, case: str) -> None:
    content = tomllib.loads(CASES[case])
    law = content.get("device", {}).get("friction_law", 0)
    content |= {"name": "heat", "title": case, "expect_bundles": [BUNDLES[law]]}
    run = {"drive_periods": 6, "steps_per_period": 4}
    (result,) = validate([fmu], [scene_from({**content, "run": run}, case)])
    assert [check.passed for check in result.checks] == [True], result


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
@pytest.mark.parametrize("last", [0.3, 1.7, 2.9, 40.2])
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
    for ratio in (999.0, 9999.0, 10001.0, 1e300):
        values = {"fidelity": 0, "averaging_order": 1, "phase": 0.7, "frequency_ratio": ratio}
        instance = instantiate().initialize(**values)
        instance.step(0.5 * TURN)
        powers.append(instance.get("friction_power")[0])
    far = powers.pop()
    for power, allowed in zip(powers, (1e-5, 1e-7, 1e-7), strict=True):
        assert power == pytest.approx(far, rel=allowed)
