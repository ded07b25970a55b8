"""Steady motion of the built FMU: figures found independently, and ways in which none exists."""

from __future__ import annotations

from math import pi, sqrt

import pytest

from slider_resonator.fmu.drive import Instance
from slider_resonator.steady.steady_velocity import find_steady


@pytest.mark.parametrize(
    ("values", "velocity"),
    [
        ({}, 0.12666700),
        ({"phase": 0.4, "load": 0.05}, 0.0986951),
        ({"phase": 0.4, "frequency_ratio": 3.0}, -0.0362968),
    ],
)
def test_steady_velocity_matches_taylor_integration_within_100_periods(
    instance: Instance, values: dict[str, float], velocity: float
) -> None:
    motion = find_steady(instance, values)
    assert motion.status == "steady"
    assert motion.steady_velocity == pytest.approx(velocity, rel=1e-6)
    assert motion.periods <= 100, "a long run needs 16 000 periods"
    assert motion.stable


def test_negative_ratio_mirrors_the_motion(instance: Instance) -> None:
    """psi -> -psi with phase 0 turns dN into -dN: half a period later that is the mirror image."""
    forward, backward = (find_steady(instance, {"frequency_ratio": r}) for r in (1.0, -1.0))
    assert forward.steady_velocity is not None
    assert backward.steady_velocity == pytest.approx(-forward.steady_velocity, rel=1e-9)


@pytest.mark.parametrize("load", [0.19, 0.199, -0.1999])
def test_steady_velocity_near_saturation_is_found(instance: Instance, load: float) -> None:
    motion = find_steady(instance, {"load": load})
    assert motion.status == "steady"
    assert motion.predicted == pytest.approx(motion.steady_velocity, rel=1e-3)


def test_load_above_friction_has_no_steady_motion(instance: Instance) -> None:
    motion = find_steady(instance, {"load": 0.25})
    assert motion.steady_velocity is None
    assert motion.status == "load_above_friction"
    assert "0.25 N" in motion.reason
    assert "0.2 N" in motion.reason


def test_lift_off_raises_the_mean_friction(instance: Instance) -> None:
    assert find_steady(instance, {"load": 0.24, "normal_amplitude": 2.0}).status == "steady"


def test_slow_beat_has_no_steady_velocity(instance: Instance) -> None:
    motion = find_steady(instance, {"frequency_ratio": 1.001})
    assert motion.steady_velocity is None
    assert motion.status == "slow_beat"
    assert "0.557042 Hz" in motion.reason


def test_irrational_ratio_far_from_integers_has_no_common_period(
    instance: Instance,
) -> None:
    motion = find_steady(instance, {"frequency_ratio": 1.37})
    assert motion.steady_velocity is None
    assert motion.status == "no_common_period"


def test_several_periods_make_a_common_one(instance: Instance) -> None:
    motion = find_steady(instance, {"frequency_ratio": 1.5, "phase": 0.3})
    assert motion.status == "steady"
    assert motion.common_period == 2


def test_stuck_device_does_not_creep(instance: Instance) -> None:
    motion = find_steady(instance, {"base_amplitude": 5e-9, "normal_amplitude": 0.5})
    assert motion.status == "stuck"
    assert motion.steady_velocity == 0.0


def test_sticking_in_every_period_is_steady(instance: Instance) -> None:
    assert find_steady(instance, {"base_amplitude": 1e-7}).status == "steady"


def test_fidelity_1_differs_little(instance: Instance) -> None:
    motion = find_steady(instance, {"fidelity": 1.0})
    assert motion.status == "steady"
    assert motion.steady_velocity == pytest.approx(0.126667, rel=1e-4)


def test_frictionless_device_is_not_unique(instance: Instance) -> None:
    motion = find_steady(instance, {"friction_coefficient": 0.0})
    assert motion.steady_velocity is None
    assert motion.status == "not_unique"


def test_undamped_resonance_has_no_steady_motion(instance: Instance) -> None:
    slipping_resonance = 3500.0 * sqrt(1.0 / 1.1)
    motion = find_steady(
        instance, {"damping_ratio": 0.0, "resonator_frequency": slipping_resonance}
    )
    assert motion.steady_velocity is None
    assert "damping_ratio = 0" in motion.reason


def test_steady_velocity_is_not_unique_if_every_reversal_is_in_flight(
    instance: Instance,
) -> None:
    """Near V = 0 the slips forward and backward then keep their impulses, whatever V is."""
    values = {"frequency_ratio": 2.0, "normal_amplitude": 1.5, "phase": pi / 2.0 - 1.466}
    assert find_steady(instance, values).status == "not_unique"


def test_search_converges_from_another_velocity(instance: Instance) -> None:
    motion = find_steady(instance, {"initial_velocity": -0.1})
    assert motion.steady_velocity == pytest.approx(0.126667, rel=1e-6)
