from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import quad

from slider_resonator.references.averaged import averaged_lugre as lugre
from slider_resonator.references.averaged.averaged_lugre import LugreCase
from slider_resonator.references.averaged.vibrating_contact import mean_load

CASE = LugreCase(
    strength=0.8, amplitude_ratio=0.7, phase=0.9, friction_coefficient=0.4, damping=1.3
)
LIFTING = replace(CASE, amplitude_ratio=1.9)
both_contacts = pytest.mark.parametrize("case", [CASE, LIFTING], ids=["closed", "lifting"])


def _mean(function: Callable[[float], float], turn: float) -> float:
    """Mean over a turn of the angle; the integrand may kink at the turning and where N vanishes."""
    kinks = np.union1d(np.linspace(-turn, 2.0 * math.pi - turn, 41), [turn])
    return sum(quad(function, *part, limit=200)[0] for part in pairwise(kinks)) / (2.0 * math.pi)


@both_contacts
@pytest.mark.parametrize("velocity", [-0.7, 0.0, 0.3, 0.79])
def test_mean_speeds_match_quadrature(velocity: float, case: LugreCase) -> None:
    q = case.strength
    turn = math.acos(velocity / q)

    def speed(angle: float) -> float:
        return abs(velocity - q * math.cos(angle))

    def weighted(angle: float) -> float:
        load = max(0.0, 1.0 + case.amplitude_ratio * math.sin(angle + case.phase))
        return (load - 1.0) * speed(angle)

    assert lugre.mean_speed(velocity, q) == pytest.approx(_mean(speed, turn), abs=1e-9)
    assert lugre.load_weighted_speed(velocity, case) == pytest.approx(
        _mean(weighted, turn), abs=1e-9
    )


def test_averages_of_a_closed_contact_match_the_paper() -> None:
    q, alpha, phi = CASE.strength, CASE.amplitude_ratio, CASE.phase
    for velocity in (-0.5, 0.2, 1.4):
        turn = math.acos(min(1.0, velocity / q))
        bracket = (
            q * math.sin(2.0 * turn) - 4.0 * velocity * math.sin(turn) - q * (math.pi - 2.0 * turn)
        )
        expected = alpha * math.sin(phi) / (2.0 * math.pi) * bracket
        assert lugre.load_weighted_speed(velocity, CASE) == pytest.approx(expected, abs=1e-12)
    assert CASE.pull == pytest.approx(0.5 * CASE.damping * q * alpha * math.sin(phi), rel=1e-12)


def test_steady_velocity_of_the_paper_case() -> None:
    velocity = lugre.steady_velocity(LugreCase())
    assert velocity == pytest.approx(0.50827, abs=5e-6)
    assert lugre.mean_friction(velocity, LugreCase()) == pytest.approx(0.0, abs=1e-12)


def test_blocking_load_stops_the_motion() -> None:
    case = LugreCase(strength=0.5, phase=0.4)
    assert lugre.steady_velocity(case, lugre.blocking_load(case)) == pytest.approx(0.0, abs=1e-12)
    assert lugre.blocking_force(1.0, 0.5, 1.0, 0.4) == pytest.approx(lugre.blocking_load(case))


@both_contacts
def test_friction_saturates_without_reversals(case: LugreCase) -> None:
    limit = case.friction_coefficient * mean_load(case.amplitude_ratio)
    for velocity in (-2.0, -0.8, 0.8, 2.0):
        assert lugre.mean_friction(velocity, case) == pytest.approx(
            math.copysign(limit, velocity), rel=1e-12
        ), "all LuGre friction is mu N in steady sliding one way"


def test_linear_forms_are_the_limit_of_small_velocities() -> None:
    weak = LugreCase(strength=1.0, amplitude_ratio=1e-4, damping=1.0)
    assert lugre.linear_velocity(weak) == pytest.approx(lugre.steady_velocity(weak), rel=1e-3)


def test_fast_displacement_is_the_integral_of_the_fast_velocity() -> None:
    angle, q, frequency = 0.7, 0.8, 50.0
    integral = quad(lambda time: -q * math.cos(frequency * time), 0.0, angle / frequency)[0]
    assert lugre.fast_displacement(angle, q, frequency) == pytest.approx(integral, rel=1e-9)


@pytest.mark.parametrize(
    ("name", "value"),
    [("strength", 0.0), ("friction_coefficient", -0.1), ("damping", -1.0), ("amplitude_ratio", -1)],
)
def test_invalid_arguments_are_refused_by_name(name: str, value: float) -> None:
    with pytest.raises(ValueError, match=name):
        LugreCase(**{name: value})


def test_cases_without_an_average_are_refused() -> None:
    with pytest.raises(ValueError, match=r"load = 0\.6"):
        lugre.steady_velocity(LugreCase(), 0.6)
    with pytest.raises(ValueError, match=r"amplitude_ratio = 1\.9"):
        lugre.linear_velocity(LIFTING)
