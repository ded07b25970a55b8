"""Averaged Coulomb friction (eqs 4 and 20): elementary integrals over the two arcs of sliding."""

from __future__ import annotations

from math import pi, sin, tau

from .averaged_friction import AveragedFriction, FastMotion, FrictionMeans
from .bristle import Bristle
from .vibrating_load import VibratingLoad


def grip(bristle: Bristle, amplitude: float, frequency: float) -> float:
    """See AveragedFriction."""
    return bristle.coefficient


def drag(bristle: Bristle, fast_velocity: float) -> float:
    """See AveragedFriction."""
    return 0.0


def mean_friction(bristle: Bristle, fast: FastMotion, load: VibratingLoad, turning: float) -> float:
    """See AveragedFriction."""
    difference = load.integral(turning, tau - turning) - load.integral(-turning, turning)
    return bristle.coefficient / tau * difference


def friction_means(bristle: Bristle, fast: FastMotion, n: int, turning: float) -> FrictionMeans:
    """See AveragedFriction."""
    mu = bristle.coefficient
    return FrictionMeans(
        mu * (1.0 - 2.0 / pi * turning), 0.0, -2.0 * mu / (n * pi) * sin(n * turning)
    )


AVERAGED_COULOMB = AveragedFriction(False, grip, drag, mean_friction, friction_means)
