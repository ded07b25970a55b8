"""The paper's averaged slow motion under LuGre friction, for bristles slower than the vibration.

Dimensionless as below (9): lengths in ``x0 = N0 / (m w0^2)``, time in ``1 / w0``, forces in ``N0``.
``velocity`` is that of the slow motion, ``strength`` q = F_T / Omega. All of it assumes
``stiffness * strength / (friction_coefficient * Omega) << 1``; `uniform_average` does not. The
contact of the paper never lifts; where it does here (``amplitude_ratio`` > 1), the averages are
those over the load as it is, never negative.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from slider_resonator.references.averaged.slow_equilibria import stable_velocity
from slider_resonator.references.averaged.vibrating_contact import (
    closed_spans,
    mean_load,
    turning_angle,
)
from slider_resonator.references.closed_forms import check_never_lifts


@dataclass(frozen=True)
class LugreCase:
    """Parameters of (9) without the frequency; see the module for the units."""

    strength: float = 1.0
    """q = F_T / Omega."""
    amplitude_ratio: float = 1.0
    """alpha = dN / N0."""
    phase: float = math.pi / 2.0
    """phi in rad."""
    friction_coefficient: float = 0.4
    """mu."""
    damping: float = 1.0
    """sigma_1."""

    def __post_init__(self) -> None:
        for name in ("strength", "friction_coefficient"):
            if not getattr(self, name) > 0.0:
                raise ValueError(f"{name} = {getattr(self, name)!r} must be greater than 0")
        for name in ("amplitude_ratio", "damping"):
            if not getattr(self, name) >= 0.0:
                raise ValueError(f"{name} = {getattr(self, name)!r} must be at least 0")

    @property
    def pull(self) -> float:
        """The driving term of (12)-(18), sigma_1 q alpha sin(phi) / 2 in a closed contact."""
        return -self.damping * _mean_of_load_times_velocity(0.0, self, -math.pi, math.pi)


def fast_displacement(angle: float, strength: float, frequency: float) -> float:
    """Return the fast part of the displacement, X_f / Omega of (10), at a drive angle in rad."""
    return -strength / frequency * math.sin(angle)


def mean_speed(velocity: float, strength: float) -> float:
    """Return the mean of |velocity - q cos(theta)| over theta, f1 of (12)."""
    turn = turning_angle(velocity, strength)
    return (velocity * (math.pi - 2.0 * turn) + 2.0 * strength * math.sin(turn)) / math.pi


def load_weighted_speed(velocity: float, case: LugreCase) -> float:
    """Return the mean of (N - 1) |velocity - q cos(theta)| over theta, f2 of (12).

    N - 1 is alpha sin(theta + phi) in a contact that never lifts.
    """
    turn = turning_angle(velocity, case.strength)
    forward = _mean_of_load_times_velocity(velocity, case, turn, 2.0 * math.pi - turn)
    backward = _mean_of_load_times_velocity(velocity, case, -turn, turn)
    return forward - backward - mean_speed(velocity, case.strength)


def mean_friction(velocity: float, case: LugreCase) -> float:
    """Return the averaged friction on the slow manifold, minus the acceleration of (16)."""
    slow, fast = mean_speed(velocity, case.strength), load_weighted_speed(velocity, case)
    load = mean_load(case.amplitude_ratio)
    resistance = (load * case.friction_coefficient - case.damping * fast) / slow
    return velocity * (resistance + case.damping * (load - 1.0)) - case.pull


def steady_velocity(case: LugreCase, load: float = 0.0) -> float:
    """Return the steady slow velocity, the root of (17), or of (23) under a load.

    Raises ValueError for a load that friction balances at no velocity.
    """
    return stable_velocity(
        lambda velocity: mean_friction(velocity, case),
        case.strength,
        load,
    )


def linear_velocity(case: LugreCase) -> float:
    """Return the steady velocity for velocities small against q, (19).

    Raises ValueError for a contact that lifts.
    """
    check_never_lifts(case.amplitude_ratio)
    return 2.0 * case.strength * case.pull / (math.pi * case.friction_coefficient)


def blocking_load(case: LugreCase) -> float:
    """Return the load that stops the motion, (24)."""
    return case.pull


def blocking_force(
    damping: float, velocity_amplitude: float, normal_amplitude: float, phase: float
) -> float:
    """Return the load in N that stops the motion of one face that never lifts, (25).

    ``damping`` is sigma_1 in s/m, ``velocity_amplitude`` F_T* / (m w) in m/s, ``normal_amplitude``
    in N.
    """
    return 0.5 * damping * velocity_amplitude * normal_amplitude * math.sin(phase)


def _mean_of_load_times_velocity(
    velocity: float, case: LugreCase, start: float, end: float
) -> float:
    """Return what an arc of theta contributes to the mean of N (velocity - q cos(theta))."""
    q, alpha, phi = case.strength, case.amplitude_ratio, case.phase

    def integral(angle: float) -> float:
        steady = velocity * angle - q * math.sin(angle)
        swinging = -velocity * math.cos(angle + phi) - 0.5 * q * (
            angle * math.sin(phi) - 0.5 * math.cos(2.0 * angle + phi)
        )
        return steady + alpha * swinging

    spans = closed_spans(start, end, alpha, phi, 1.0)
    return sum(integral(last) - integral(first) for first, last in spans) / (2.0 * math.pi)
