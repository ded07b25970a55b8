"""The averaged theory of the paper: against quadrature, its limits and its figures."""

import math
from collections.abc import Callable
from functools import partial
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import quad

from slider_resonator.device.device import Device
from slider_resonator.references.averaged.averaged_motion import slow_trajectory
from slider_resonator.references.averaged.uniform_average import LugreCase
from studies.paper import slow_theory as theory

CASE = LugreCase(
    strength=0.8, amplitude_ratio=0.7, phase=0.9, friction_coefficient=0.4, damping=1.3
)


def _mean(function: Callable[[float], float], turn: float) -> float:
    """Mean over a turn of the angle, of an integrand that may kink at the turning."""
    kinks = np.union1d(np.linspace(-turn, 2.0 * math.pi - turn, 41), [turn])
    return sum(quad(function, *part, limit=200)[0] for part in pairwise(kinks)) / (2.0 * math.pi)


def test_linear_velocities_are_limits_of_small_ones() -> None:
    linear = theory.linear_velocity(1.3, 1e-3, 0.8)
    assert linear == pytest.approx(1.3e-3 * math.sin(0.8)), "(7) is q alpha sin(phase)"
    exact = theory.steady_velocity(1.3, 1e-3, 0.8)
    assert exact == pytest.approx(linear, rel=1e-6), "(5) becomes (7) for small velocities"
    weak = LugreCase(strength=1.0, amplitude_ratio=1e-4, damping=1.0)
    linear = theory.lugre_linear_velocity(weak)
    assert linear == pytest.approx(theory.lugre_steady_velocity(weak), rel=1e-3)


def test_blocking_loads_stop_the_motion() -> None:
    """(21) is the load of (20) at rest."""
    case, stiff = LugreCase(strength=0.5, phase=0.4), (CASE, 1000.0, 1000.0)
    blocking = theory.uniform_blocking_load(*stiff)
    for velocity, allowed in (
        (theory.steady_velocity(1.3, 0.7, 1.1, theory.blocking_load(0.7, 1.1)), 1e-14),
        (theory.lugre_steady_velocity(case, theory.lugre_blocking_load(case)), 1e-12),
        (theory.uniform_velocity(*stiff, load=blocking), 1e-10),
    ):
        assert velocity == pytest.approx(0.0, abs=allowed)


@pytest.mark.parametrize("load", [1.1, -1.1, 1.5, math.nan])
def test_loads_above_friction_are_refused(load: float) -> None:
    for velocity in (
        partial(theory.steady_velocity, 1.0, 1.0, 0.5),
        partial(theory.lugre_steady_velocity, LugreCase()),
        partial(theory.uniform_velocity, LugreCase(), 10.0, 10.0),
    ):
        with pytest.raises(ValueError, match=r"load = "):
            velocity(load=load)


def test_table_1_has_the_strength_and_length_of_the_paper() -> None:
    assert theory.strength_of(Device()) == pytest.approx(1.301353, abs=5e-7), "q"
    assert theory.length_scale(Device()) == pytest.approx(0.181818, abs=5e-7), "x0 in m"


def test_linear_beat_is_where_the_slow_motion_settles() -> None:
    strength, alpha, detuning = 1.0, 1e-3, 1.5
    times = np.linspace(0.0, 40.0 * math.pi / detuning, 4001)
    position, _ = slow_trajectory(
        lambda time, v: theory.slow_acceleration(v, strength, alpha, detuning * time + 0.3), times
    )
    late = times > times[-1] - 2.0 * math.pi / detuning
    assert np.ptp(position[late]) / 2.0 == pytest.approx(
        theory.linear_beat_displacement(strength, alpha, detuning), rel=1e-4
    )


@pytest.mark.parametrize("velocity", [-0.7, 0.0, 0.3, 0.79])
def test_slow_manifold_friction_matches_quadrature(velocity: float) -> None:
    q, mu, damping = CASE.strength, CASE.friction_coefficient, CASE.damping
    turn = math.acos(velocity / q)

    def speed(angle: float) -> float:
        return abs(velocity - q * math.cos(angle))

    def load(angle: float) -> float:
        return 1.0 + CASE.amplitude_ratio * math.sin(angle + CASE.phase)

    loaded = _mean(lambda angle: load(angle) * speed(angle), turn)
    moved = _mean(lambda angle: load(angle) * (velocity - q * math.cos(angle)), turn)
    bristle = velocity / _mean(speed, turn)  # the stretch that a turn leaves as it was
    expected = mu * bristle + damping * (moved - bristle * loaded)
    assert theory.slow_manifold_friction(velocity, CASE) == pytest.approx(expected, abs=1e-9)


def test_steady_velocity_of_the_paper_case() -> None:
    velocity = theory.lugre_steady_velocity(LugreCase())
    assert velocity == pytest.approx(0.50827, abs=5e-6)
    assert theory.slow_manifold_friction(velocity, LugreCase()) == pytest.approx(0.0, abs=1e-12)


def test_soft_bristle_is_on_the_slow_manifold() -> None:
    limit = theory.lugre_steady_velocity(LugreCase())
    errors = [abs(theory.uniform_velocity(LugreCase(), s, 1000.0) - limit) for s in (10.0, 1.0)]
    assert errors[1] < 1e-6, "(17) is the limit of a bristle slower than the vibration"
    assert errors[0] / errors[1] == pytest.approx(100.0, rel=0.1), "the error is of order kappa^2"


@pytest.mark.parametrize(("phase", "order"), [(math.pi / 2.0, 1.0), (0.5, 0.5)])
def test_stiff_bristle_approaches_coulomb_friction(phase: float, order: float) -> None:
    """The turnover takes an angle of order kappa^(-1/2), which in quadrature cancels."""
    target = theory.steady_velocity(1.0, 1.0, phase)
    case = LugreCase(strength=0.4, phase=phase)  # q / mu = 1: velocities in units of mu
    errors = [
        abs(theory.uniform_velocity(case, stiffness, 1000.0) / 0.4 - target)
        for stiffness in (1e8, 1e10)
    ]
    assert errors[1] < 3e-4, "(5) is the limit of a bristle faster than the vibration"
    assert math.log10(errors[0] / errors[1]) / 2.0 == pytest.approx(order, abs=0.02)
