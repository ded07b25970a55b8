"""`prediction_valid`: where `steady_velocity` and `blocking_force` say what the slider does."""

from __future__ import annotations

import math

import pytest

from tests.fmu.host import Instance, Instantiate
from tests.fmus import both_fmus

pytestmark = both_fmus

PERIOD = math.tau / 3500.0
FULL_FRICTION = 2 * 0.1 * 1.0
SLIP_RESONANCE = {"resonator_mass": 3.0, "resonator_frequency": 1750.0, "damping_ratio": 0.0}
"""wn^2 = (1 - r_m) w^2."""

BEYOND_AVERAGES: dict[str, dict[str, float]] = {
    "runs away backwards": {"load": 1.01 * FULL_FRICTION},
    "runs away forwards": {"load": -1.01 * FULL_FRICTION},
    "no vibration": {"base_amplitude": 0.0},
    "held by friction": {"base_amplitude": 1e-9},
    "held by bristles": {"friction_law": 1, "bristle_stiffness": 1e9, "base_amplitude": 1e-9},
    "undamped resonance": SLIP_RESONANCE,
    "no friction": {"friction_coefficient": 0.0},
    "no normal load": {"normal_preload": 0.0, "normal_amplitude": 0.0},
    "load stands at zero": {"frequency_ratio": 0.0, "phase": -math.pi / 2.0},
}
WITHIN: dict[str, dict[str, float]] = {
    "table 1": {},
    "nearly full friction": {"load": 0.99 * FULL_FRICTION},
    "no preload": {"normal_preload": 0.0},
    "direct drive": {"base_amplitude": 0.0, "tangential_force": 5.0},
    "rigid": {"resonator_mass": 0.0, "tangential_force": 5.0},
    "undamped": {"damping_ratio": 0.0, "resonator_frequency": 3000.0},
    "resonance of the held slider": {"damping_ratio": 0.0},
    "third multiple, lifting": {"frequency_ratio": 3.0, "normal_amplitude": 2.0},
    "bristles": {"friction_law": 1},
    "bristles that only bend": {"friction_law": 1, "base_amplitude": 1e-9},
}


def valid(instance: Instance) -> float:
    (value,) = instance.get("prediction_valid")
    return value


@pytest.mark.parametrize("fidelity", [0, 1, 2])
@pytest.mark.parametrize("situation", WITHIN)
def test_averages_apply(instantiate: Instantiate, situation: str, fidelity: int) -> None:
    first_order = instantiate().initialize(
        fidelity=fidelity, averaging_order=1, **WITHIN[situation]
    )
    assert valid(first_order) == 1.0


@pytest.mark.parametrize("situation", WITHIN)
def test_fixed_points_are_found(instantiate: Instantiate, situation: str) -> None:
    """But under a bristle that holds the slider, or where a resonator never forgets its start."""
    undamped = WITHIN[situation].get("damping_ratio") == 0.0
    none = undamped or situation == "bristles that only bend"
    assert valid(instantiate().initialize(**WITHIN[situation])) == (0.0 if none else 1.0)


@pytest.mark.parametrize("ratio", [1.37, 1.0003])
def test_there_are_no_steady_values_where_the_load_never_repeats(
    instantiate: Instantiate, ratio: float
) -> None:
    """What is predicted then is the balance of first order."""
    found = []
    for order in (1, 2):
        instance = instantiate().initialize(averaging_order=order, frequency_ratio=ratio)
        found.append(instance.get("steady_velocity", "blocking_force"))
        assert order == 1 or valid(instance) == 0.0
    assert found[0] == found[1]


@pytest.mark.parametrize("situation", BEYOND_AVERAGES)
def test_averages_do_not_apply(instantiate: Instantiate, situation: str) -> None:
    assert valid(instantiate().initialize(**BEYOND_AVERAGES[situation])) == 0.0


def test_a_slider_that_runs_away_says_so_at_once(instance: Instance) -> None:
    instance.run(20, PERIOD)
    assert valid(instance) == 1.0
    instance.set(load=1.5 * FULL_FRICTION)
    assert valid(instance) == 0.0
    before = instance.get("mean_velocity")[0]
    instance.run(2000, PERIOD)
    gone = instance.get("mean_velocity")[0] - before
    expected = -0.5 * FULL_FRICTION / 1.1 * 2000 * PERIOD
    assert gone == pytest.approx(expected, rel=0.5), "no steady velocity: it goes on to accelerate"
    instance.set(load=0.0)
    assert valid(instance) == 1.0
