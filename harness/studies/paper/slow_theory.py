"""The averaged theory of the paper, dimensionless, for a contact that never lifts.

Velocities are in ``x0 w0``, time in ``1 / w0``, forces in the mean friction ``faces mu N0``, or
with LuGre friction in ``N0``. ``strength`` is q, ``amplitude_ratio`` alpha, ``phase`` phi in rad.
"""

from math import acos, hypot, pi, sin

from slider_resonator.device.device import Device
from slider_resonator.references.averaged import averaged_coulomb, uniform_average
from slider_resonator.references.averaged.device_average import stable_velocity
from slider_resonator.references.averaged.uniform_average import LugreCase
from slider_resonator.references.equivalent_force import equivalent_force


def length_scale(device: Device) -> float:
    """Return x0 = faces mu N0 / ((m + M) w0^2) in m, below (29), at w0 = 1 rad/s."""
    return device.mean_friction / device.total_mass


def strength_of(device: Device) -> float:
    """Return q = F_T / Omega of a device with its resonator, below (4) and (34)."""
    return equivalent_force(device).velocity_amplitude / length_scale(device)


def slow_acceleration(
    velocity: float, strength: float, amplitude_ratio: float, phase: float
) -> float:
    """Return the acceleration of the slow motion under Coulomb friction, (4).

    With a phase that drifts it is (A.2).
    """
    return -averaged_coulomb.mean_friction(velocity, strength, amplitude_ratio, phase)


def steady_velocity(
    strength: float, amplitude_ratio: float, phase: float, load: float = 0.0
) -> float:
    """Return the steady velocity, the root of (5), or of (20) under a load.

    Raises ValueError for a load that friction does not balance.
    """
    return stable_velocity(
        lambda velocity: -slow_acceleration(velocity, strength, amplitude_ratio, phase),
        strength,
        load,
    )


def linear_velocity(strength: float, amplitude_ratio: float, phase: float) -> float:
    """Return the steady velocity for velocities small against the strength, (7)."""
    return strength * amplitude_ratio * sin(phase)


def blocking_load(amplitude_ratio: float, phase: float) -> float:
    """Return the load that stops the motion, (21)."""
    return 2.0 * amplitude_ratio / pi * sin(phase)


def linear_beat_displacement(strength: float, amplitude_ratio: float, detuning: float) -> float:
    """Return the amplitude of the slow displacement that (A.3) settles to at a detuning, not 0."""
    velocity = 2.0 * amplitude_ratio / pi / hypot(detuning, 2.0 / (pi * strength))
    return velocity / abs(detuning)


def slow_manifold_friction(velocity: float, case: LugreCase) -> float:
    """Return the averaged LuGre friction of bristles slower than the vibration, as in (16).

    It assumes ``stiffness * strength / (friction_coefficient * Omega) << 1``.
    """
    q = case.strength
    turn = acos(max(-1.0, min(1.0, velocity / q)))
    mean_speed = (velocity * (pi - 2.0 * turn) + 2.0 * q * sin(turn)) / pi  # f1 of (12)
    bracket = q * sin(2.0 * turn) - 4.0 * velocity * sin(turn) - q * (pi - 2.0 * turn)
    weighted_speed = case.amplitude_ratio * sin(case.phase) / (2.0 * pi) * bracket  # f2 of (12)
    resistance = (case.friction_coefficient - case.damping * weighted_speed) / mean_speed
    return velocity * resistance - lugre_blocking_load(case)


def lugre_steady_velocity(case: LugreCase, load: float = 0.0) -> float:
    """Return the steady velocity, the root of (17), or of (23) under a load.

    Raises ValueError for a load that friction does not balance.
    """
    return stable_velocity(lambda v: slow_manifold_friction(v, case), case.strength, load)


def lugre_linear_velocity(case: LugreCase) -> float:
    """Return the steady velocity for velocities small against q, (19)."""
    return 2.0 * case.strength * lugre_blocking_load(case) / (pi * case.friction_coefficient)


def lugre_blocking_load(case: LugreCase) -> float:
    """Return the load that stops the motion, (24)."""
    return 0.5 * case.damping * case.strength * case.amplitude_ratio * sin(case.phase)


def uniform_velocity(
    case: LugreCase, stiffness: float, frequency: float, load: float = 0.0
) -> float:
    """Return the steady velocity by the uniform average at sigma_0 and Omega."""
    return stable_velocity(
        lambda velocity: uniform_average.mean_friction(velocity, case, stiffness, frequency),
        case.strength,
        load,
    )


def uniform_blocking_load(case: LugreCase, stiffness: float, frequency: float) -> float:
    """Return the load that stops the motion by the uniform average at sigma_0 and Omega."""
    return -uniform_average.mean_friction(0.0, case, stiffness, frequency)
