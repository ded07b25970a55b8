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


@pytest.mark.parametrize(
    ("ratio", "amplitude", "phase"),
    [(2.0, 3.0, 0.3), (2.0, 2.0, 1.0), (4.0, 3.0, 2.5), (-2.0, 3.0, 2.5)],
)
def test_a_family_of_motions_has_no_steady_one(
    instance: Instance, ratio: float, amplitude: float, phase: float
) -> None:
    """Even ratios with flight while sliding turns; the search begins at an end of the family."""
    values = {"frequency_ratio": ratio, "normal_amplitude": amplitude, "phase": phase}
    motion = find_steady(instance, values)
    assert motion.status == "not_unique"
    assert motion.steady_velocity is None
    assert motion.predicted > 0.01


def test_stuck_device_does_not_creep(instance: Instance) -> None:
    motion = find_steady(instance, {"base_amplitude": 5e-9, "normal_amplitude": 0.5})
    assert motion.status == "stuck"
    assert motion.steady_velocity == 0.0


def test_fidelity_1_differs_little(instance: Instance) -> None:
    motion = find_steady(instance, {"fidelity": 1.0})
    assert motion.status == "steady"
    assert motion.steady_velocity == pytest.approx(0.126667, rel=1e-4)


def test_undamped_resonance_has_no_steady_motion(instance: Instance) -> None:
    slipping_resonance = 3500.0 * sqrt(1.0 / 1.1)
    motion = find_steady(
        instance, {"damping_ratio": 0.0, "resonator_frequency": slipping_resonance}
    )
    assert motion.steady_velocity is None
    assert "damping_ratio = 0" in motion.reason


@pytest.mark.parametrize(
    ("values", "periods"),
    [
        ({"load": 0.24, "normal_amplitude": 2.0}, 1),
        ({"base_amplitude": 1e-7}, 1),
        ({"frequency_ratio": 1.5, "phase": 0.3}, 2),
    ],
    ids=["load held by a lifting contact", "stick in every period", "ratio 3 : 2"],
)
def test_motion_is_steady(instance: Instance, values: dict[str, float], periods: int) -> None:
    motion = find_steady(instance, values)
    assert (motion.status, motion.common_period) == ("steady", periods)


@pytest.mark.parametrize(
    ("values", "status", "reasons"),
    [
        ({"load": 0.25}, "load_above_friction", ("0.25 N", "0.2 N")),
        ({"frequency_ratio": 1.001}, "slow_beat", ("0.557042 Hz",)),
        ({"frequency_ratio": 1.37}, "no_common_period", ()),
        ({"friction_coefficient": 0.0}, "not_unique", ()),
        # Near V = 0 the slips forward and backward keep their impulses, whatever V is.
        (
            {"frequency_ratio": 2.0, "normal_amplitude": 1.5, "phase": pi / 2.0 - 1.466},
            "not_unique",
            (),
        ),
    ],
    ids=["load", "beat", "irrational ratio", "no friction", "reversals in flight"],
)
def test_missing_steady_motion_is_explained(
    instance: Instance, values: dict[str, float], status: str, reasons: tuple[str, ...]
) -> None:
    motion = find_steady(instance, values)
    assert motion.steady_velocity is None
    assert motion.status == status
    for reason in reasons:
        assert reason in motion.reason
