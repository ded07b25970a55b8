"""Steady motion of the built FMU: figures found independently, and ways in which none exists."""

from __future__ import annotations

from math import pi, sqrt

import pytest

from slider_resonator.fmu.instance import Instance
from slider_resonator.steady.steady_velocity import find_steady


@pytest.mark.parametrize(
    ("values", "velocity"),
    [
        ({}, 0.12666700),
        ({"phase": 0.4, "load": 0.05}, 0.0986951),
        ({"phase": 0.4, "frequency_ratio": 3.0}, -0.0362968),
    ],
)
def test_figures_of_taylor_integration_are_met_in_a_hundred_periods(
    instance: Instance, values: dict[str, float], velocity: float
) -> None:
    motion = find_steady(instance, values)
    assert motion.status == "steady"
    assert motion.steady_velocity == pytest.approx(velocity, rel=1e-6)
    assert motion.periods <= 100, "a long run needs 16 000 periods"
    assert motion.stable


def test_a_negative_ratio_mirrors_the_motion(instance: Instance) -> None:
    """psi -> -psi with phase 0 turns dN into -dN: half a period later that is the mirror image."""
    forward, backward = (find_steady(instance, {"frequency_ratio": r}) for r in (1.0, -1.0))
    assert forward.steady_velocity is not None
    assert backward.steady_velocity == pytest.approx(-forward.steady_velocity, rel=1e-9)


@pytest.mark.parametrize("load", [0.19, 0.199, -0.1999])
def test_next_to_saturation_where_newton_alone_fails(instance: Instance, load: float) -> None:
    motion = find_steady(instance, {"load": load})
    assert motion.status == "steady"
    assert motion.predicted == pytest.approx(motion.steady_velocity, rel=1e-3)


def test_a_load_above_friction_has_no_steady_motion(instance: Instance) -> None:
    motion = find_steady(instance, {"load": 0.25})
    assert motion.steady_velocity is None
    assert motion.status == "load_above_friction"
    assert "0.25 N" in motion.reason
    assert "0.2 N" in motion.reason


def test_lift_off_lowers_the_friction_that_a_load_must_beat(instance: Instance) -> None:
    assert find_steady(instance, {"load": 0.24, "normal_amplitude": 2.0}).status == "steady"


def test_a_slow_beat_is_named(instance: Instance) -> None:
    motion = find_steady(instance, {"frequency_ratio": 1.001})
    assert motion.steady_velocity is None
    assert motion.status == "slow_beat"
    assert "0.557042 Hz" in motion.reason


def test_a_ratio_far_from_integers_has_no_common_period_but_no_slow_beat(
    instance: Instance,
) -> None:
    motion = find_steady(instance, {"frequency_ratio": 1.37})
    assert motion.steady_velocity is None
    assert motion.status == "no_common_period"


def test_several_periods_make_a_common_one(instance: Instance) -> None:
    motion = find_steady(instance, {"frequency_ratio": 1.5, "phase": 0.3})
    assert motion.status == "steady"
    assert motion.common_period == 2


def test_a_stuck_device_does_not_creep(instance: Instance) -> None:
    motion = find_steady(instance, {"base_amplitude": 5e-9, "normal_amplitude": 0.5})
    assert motion.status == "stuck"
    assert motion.steady_velocity == 0.0


def test_sticking_in_every_period_is_steady_all_the_same(instance: Instance) -> None:
    assert find_steady(instance, {"base_amplitude": 1e-7}).status == "steady"


def test_fidelity_1_differs_little(instance: Instance) -> None:
    motion = find_steady(instance, {"fidelity": 1.0})
    assert motion.status == "steady"
    assert motion.steady_velocity == pytest.approx(0.126667, rel=1e-4)


def test_without_friction_every_velocity_is_steady(instance: Instance) -> None:
    motion = find_steady(instance, {"friction_coefficient": 0.0})
    assert motion.steady_velocity is None
    assert motion.status == "not_unique"


def test_without_damping_at_resonance_nothing_repeats(instance: Instance) -> None:
    slipping_resonance = 3500.0 * sqrt(1.0 / 1.1)
    motion = find_steady(
        instance, {"damping_ratio": 0.0, "resonator_frequency": slipping_resonance}
    )
    assert motion.steady_velocity is None
    assert "damping_ratio = 0" in motion.reason


def test_a_contact_that_is_lifted_at_every_reversal_does_not_choose_a_velocity(
    instance: Instance,
) -> None:
    """Near V = 0 the slips forward and backward then keep their impulses, whatever V is."""
    values = {"frequency_ratio": 2.0, "normal_amplitude": 1.5, "phase": pi / 2.0 - 1.466}
    assert find_steady(instance, values).status == "not_unique"


def test_the_search_can_begin_elsewhere(instance: Instance) -> None:
    motion = find_steady(instance, {"initial_velocity": -0.1})
    assert motion.steady_velocity == pytest.approx(0.126667, rel=1e-6)
