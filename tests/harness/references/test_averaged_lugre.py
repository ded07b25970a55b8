from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp

from harness.references import averaged_lugre as lugre
from harness.references.averaged_lugre import LugreCase

CASE = LugreCase(
    strength=0.8, amplitude_ratio=0.7, phase=0.9, friction_coefficient=0.4, damping=1.3
)


def _mean(function: object, turn: float) -> float:
    parts = ((-turn, turn), (turn, 2.0 * math.pi - turn))
    return sum(quad(function, *part)[0] for part in parts) / (2.0 * math.pi)


@pytest.mark.parametrize("velocity", [-0.7, 0.0, 0.3, 0.79])
def test_averages_of_the_speed_are_the_integrals(velocity: float) -> None:
    q = CASE.strength
    turn = math.acos(velocity / q)

    def speed(angle: float) -> float:
        return abs(velocity - q * math.cos(angle))

    def weighted(angle: float) -> float:
        return CASE.amplitude_ratio * math.sin(angle + CASE.phase) * speed(angle)

    assert lugre.mean_speed(velocity, q) == pytest.approx(_mean(speed, turn), abs=1e-10)
    assert lugre.load_weighted_speed(velocity, CASE) == pytest.approx(
        _mean(weighted, turn), abs=1e-10
    )


@pytest.mark.parametrize("velocity", [-0.7, 0.1, 0.6])
def test_slow_rates_are_the_full_rates_averaged_over_a_turn(velocity: float) -> None:
    """(11): the bristle held, the velocity V - q cos(theta) put into (9)."""
    stiffness, bristle, frequency = 50.0, 0.003, 1.0
    turn = math.acos(velocity / CASE.strength)

    def rates(angle: float) -> np.ndarray:
        fast = velocity - CASE.strength * math.cos(angle)
        state = np.array([0.0, fast, bristle])
        return lugre.full_rates(angle / frequency, state, CASE, stiffness, frequency)

    acceleration, rate = lugre.slow_rates(velocity, bristle, CASE, stiffness)
    assert acceleration == pytest.approx(_mean(lambda a: rates(a)[1], turn), abs=1e-9)
    assert rate == pytest.approx(_mean(lambda a: rates(a)[2], turn), abs=1e-9)


def test_slow_manifold_is_where_the_bristle_rests_and_the_rest_follows() -> None:
    velocity, stiffness = 0.35, 100.0
    force = lugre.slow_manifold(velocity, CASE)
    acceleration, rate = lugre.stretched_rates(velocity, force, CASE, stiffness)
    assert rate == pytest.approx(0.0, abs=1e-12), "(14) is the rest point of (13)"
    assert acceleration == pytest.approx(-lugre.mean_friction(velocity, CASE), rel=1e-12)
    off = lugre.stretched_rates(velocity, force + 1e-3, CASE, stiffness)[1]
    assert off == pytest.approx(
        -1e-3 * stiffness * lugre.boundary_layer_rate(velocity, CASE), rel=1e-9
    ), "(15) is the decay toward it"


def test_steady_velocity_of_the_paper_s_case() -> None:
    velocity = lugre.steady_velocity(LugreCase())
    assert velocity == pytest.approx(0.50827, abs=5e-6)
    assert lugre.mean_friction(velocity, LugreCase()) == pytest.approx(0.0, abs=1e-12)


def test_blocking_load_stops_the_motion() -> None:
    case = LugreCase(strength=0.5, phase=0.4)
    assert lugre.steady_velocity(case, lugre.blocking_load(case)) == pytest.approx(0.0, abs=1e-12)
    assert lugre.blocking_force(1.0, 0.5, 1.0, 0.4) == pytest.approx(lugre.blocking_load(case))


def test_friction_saturates_where_nothing_reverses() -> None:
    for velocity in (-2.0, -0.8, 0.8, 2.0):
        assert lugre.mean_friction(velocity, CASE) == pytest.approx(
            math.copysign(CASE.friction_coefficient, velocity), rel=1e-12
        ), "all LuGre friction is mu in steady sliding one way"


def test_linear_forms_are_the_limit_of_small_velocities() -> None:
    weak = LugreCase(strength=1.0, amplitude_ratio=1e-4, damping=1.0)
    assert lugre.linear_velocity(weak) == pytest.approx(lugre.steady_velocity(weak), rel=1e-3)
    velocity = 1e-5
    assert lugre.linear_slow_acceleration(velocity, weak) == pytest.approx(
        -lugre.mean_friction(velocity, weak), rel=1e-3
    )


def test_fast_displacement_is_the_integral_of_the_fast_velocity() -> None:
    angle, q, frequency = 0.7, 0.8, 50.0
    integral = quad(lambda time: -q * math.cos(frequency * time), 0.0, angle / frequency)[0]
    assert lugre.fast_displacement(angle, q, frequency) == pytest.approx(integral, rel=1e-9)


@pytest.mark.slow
def test_the_full_equations_slide_at_the_slow_manifold_s_velocity() -> None:
    """A bristle far slower than the vibration, kappa = 0.025: (17) holds."""
    frequency, stiffness = 1000.0, 10.0
    period = 2.0 * math.pi / frequency
    solution = solve_ivp(
        lugre.full_rates,
        (0.0, 1500 * period),
        (0.0, 0.508 - 1.0, 0.0127),
        method="DOP853",
        t_eval=[1300 * period, 1500 * period],
        args=(LugreCase(), stiffness, frequency),
        rtol=1e-8,
        atol=1e-10,
        max_step=period / 10,
    )
    velocity = np.diff(solution.y[0])[0] / (200 * period)
    assert velocity == pytest.approx(lugre.steady_velocity(LugreCase()), abs=1e-3)


@pytest.mark.parametrize(
    ("name", "value"),
    [("strength", 0.0), ("friction_coefficient", -0.1), ("damping", -1.0), ("amplitude_ratio", -1)],
)
def test_what_has_no_answer_is_refused_by_name(name: str, value: float) -> None:
    with pytest.raises(ValueError, match=name):
        LugreCase(**{name: value})


def test_a_load_above_friction_is_refused() -> None:
    with pytest.raises(ValueError, match=r"load = 0\.6"):
        lugre.steady_velocity(LugreCase(), 0.6)
