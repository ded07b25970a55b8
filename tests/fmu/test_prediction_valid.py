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
SEVERAL: dict[str, tuple[dict[str, float], float]] = {
    "either way around": (
        {
            **{"resonator_mass": 0.0645, "resonator_frequency": 167.0, "damping_ratio": 0.2},
            **{"normal_preload": 0.0279, "normal_amplitude": 0.0558},
            **{"bristle_stiffness": 1.39e7, "bristle_damping": 92.0},
            **{"frequency_ratio": 2.0 / 3.0, "phase": 0.164},
        },
        0.0,
    ),
    "turning back or not": (
        {
            **{"resonator_mass": 0.529, "resonator_frequency": 261.0, "damping_ratio": 0.067},
            **{"normal_preload": 0.243, "normal_amplitude": 0.243},
            **{"bristle_stiffness": 4.1e6, "bristle_damping": 13.3},
            **{"frequency_ratio": 2.0, "phase": 1.233},
        },
        0.1048,
    ),
}
"""Values that leave the slider several motions of one mean velocity, and the load of one [N]."""


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
def test_held_orbits_are_found(instantiate: Instantiate, situation: str) -> None:
    """An undamped resonator never forgets its start: its device has no orbit of its own."""
    undamped = WITHIN[situation].get("damping_ratio") == 0.0
    assert valid(instantiate().initialize(**WITHIN[situation])) == (0.0 if undamped else 1.0)


@pytest.mark.parametrize(
    "situation",
    [
        {"damping_ratio": 0.0, "resonator_frequency": 3000.0},
        {"damping_ratio": 1e-6},
        {"friction_coefficient": 20.0, "damping_ratio": 0.005},
        {"frequency_ratio": 1.37},
        # As they bend after each reversal, bristles damp thousands of times what friction takes.
        {"friction_law": 1, "bristle_damping": 1e5},
    ],
)
def test_motion_that_is_not_slow_is_averaged_to_first_order(
    instantiate: Instantiate, situation: dict[str, float]
) -> None:
    ends = []
    for order in (1, 2):
        instance = instantiate().initialize(fidelity=0, averaging_order=order, **situation)
        instance.run(10, PERIOD)
        ends.append(instance.get("position", "mean_velocity", "slow_motion_error"))
        assert order == 1 or valid(instance) == 0.0
    assert ends[0] == ends[1]


@pytest.mark.parametrize("situation", SEVERAL)
def test_one_of_several_motions_at_a_velocity_is_not_chosen(
    instantiate: Instantiate, situation: str
) -> None:
    """Friction is half of the drive force: the load that holds a velocity depends on the past."""
    start, load = SEVERAL[situation]
    values = {"friction_law": 1, "friction_faces": 1, "friction_coefficient": 1.0, **start}
    values |= {"base_amplitude": 1e-5, "drive_frequency": 1000.0, "load": load}
    assert valid(instantiate().initialize(averaging_order=1, **values)) == 1.0
    assert valid(instantiate().initialize(averaging_order=2, **values)) == 0.0


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
