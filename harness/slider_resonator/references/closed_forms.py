"""The averaged theory of the paper for Coulomb friction, dimensionless and dimensional.

Dimensionless velocity is in units of ``x0 w0`` and dimensionless load in units of the mean friction
``faces mu N0``, with ``x0`` as in ``EquivalentForce``. ``strength`` is q, ``amplitude_ratio`` is
alpha, both of (2)-(4); ``phase`` is the phase of the normal load relative to the tangential force.
Dimensional functions take the phase relative to the base excitation, as the FMU input is.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from slider_resonator.device.device import Device
from slider_resonator.references.halving import root_by_halving

REFERENCE_FREQUENCY = 1.0
"""The arbitrary reference frequency w0 of the paper, rad/s."""

_RESONANCE_RESOLUTION = 1e-12


@dataclass(frozen=True)
class EquivalentForce:
    """The single tangential force that stands for the resonator, (30)-(34), SI units.

    The slider of mass M + m obeys (33) with force ``amplitude * sin(w t - angle)``. The resonator
    moves as ``resonator_amplitude * sin(w t - resonator_angle)``, (32).
    """

    amplitude: float
    """F_T* in N."""
    angle: float
    """theta1 in rad."""
    resonator_amplitude: float
    """Y0 in m; negative when the direct drive outweighs the base excitation."""
    resonator_angle: float
    """theta in rad."""
    length_scale: float
    """x0 = faces mu N0 / ((m + M) w0^2) in m, below (29)."""
    strength: float
    """q = F_T / Omega, dimensionless, below (4)."""
    velocity_amplitude: float
    """Amplitude of the slider's fast velocity, F_T* / ((M + m) w), in m/s."""
    ripple_amplitude: float
    """Amplitude of the slider's fast displacement, F_T* / ((M + m) w^2), in m."""


def steady_velocity(strength: float, amplitude_ratio: float, phase: float) -> float:
    """Return the dimensionless steady velocity without load, the root of (5).

    Raises ValueError unless ``strength`` > 0 and 0 <= ``amplitude_ratio`` <= 1.
    """
    return loaded_velocity(strength, amplitude_ratio, phase, 0.0)


def linear_velocity(strength: float, amplitude_ratio: float, phase: float) -> float:
    """Return the dimensionless steady velocity for velocities small against the strength, (7)."""
    return strength * amplitude_ratio * math.sin(phase)


def loaded_velocity(strength: float, amplitude_ratio: float, phase: float, load: float) -> float:
    """Return the dimensionless steady velocity under a dimensionless load, the root of (20).

    Raises ValueError unless ``strength`` > 0, 0 <= ``amplitude_ratio`` <= 1, and the load lies
    between -1 and 1: a load above full friction runs away.
    """
    check_strength(strength)
    check_never_lifts(amplitude_ratio)
    if not -1.0 < load < 1.0:
        raise ValueError(
            f"load = {load!r} of the mean friction: (20) has a root only between -1 and 1, "
            "a greater load runs away"
        )
    pull = amplitude_ratio * math.sin(phase)

    def imbalance(angle: float) -> float:
        return 1.0 - 2.0 / math.pi * (angle + pull * math.sin(angle)) + load

    # The imbalance falls from 1 + load to load - 1 over this interval, so it has exactly one root.
    return strength * math.cos(root_by_halving(imbalance, 0.0, math.pi))


def blocking_load(amplitude_ratio: float, phase: float) -> float:
    """Return the dimensionless load that stops the motion, (21).

    Raises ValueError unless 0 <= ``amplitude_ratio`` <= 1.
    """
    check_never_lifts(amplitude_ratio)
    return 2.0 * amplitude_ratio / math.pi * math.sin(phase)


def equivalent_force(device: Device) -> EquivalentForce:
    """Return the equivalent single-degree-of-freedom force of a device, (30)-(34).

    A direct drive ``tangential_force * sin(w t)`` is included: it adds to F_T* and drives the
    resonator through the slider. Raises ValueError for an undamped resonator at its slipping
    resonance, and for a device without friction, whose length scale is zero.
    """
    frequency = device.drive_frequency
    share = device.mass_ratio
    base_acceleration = device.base_amplitude * frequency**2
    detuning = device.resonator_frequency**2 - frequency**2 * (1.0 - share)
    damping = 2.0 * device.damping_ratio * device.resonator_frequency * frequency
    response = math.hypot(detuning, damping)
    if response <= _RESONANCE_RESOLUTION * frequency**2:
        raise ValueError(
            f"damping_ratio = {device.damping_ratio!r} at resonator_frequency = "
            f"{device.resonator_frequency!r} rad/s, the slipping resonance: there is no steady "
            "state; damping_ratio must be greater than 0 or the frequencies differ"
        )
    friction = device.mean_friction
    if friction <= 0.0:
        raise ValueError(
            f"mean friction = {friction!r} N from friction_coefficient = "
            f"{device.friction_coefficient!r} and normal_preload = {device.normal_preload!r} N "
            "must be greater than 0: the length scale x0 vanishes with it"
        )

    drive = base_acceleration - device.tangential_force / device.slider_mass
    resonator_amplitude = (1.0 - share) * drive / response
    resonator_angle = math.atan2(damping, detuning)
    reaction = device.resonator_mass * frequency**2 * resonator_amplitude
    in_phase = (
        device.resonator_mass * base_acceleration
        + device.tangential_force
        + reaction * math.cos(resonator_angle)
    )
    lagging = reaction * math.sin(resonator_angle)
    amplitude = math.hypot(in_phase, lagging)
    velocity_amplitude = amplitude / (device.total_mass * frequency)
    length_scale = friction / (device.total_mass * REFERENCE_FREQUENCY**2)
    return EquivalentForce(
        amplitude=amplitude,
        angle=math.atan2(lagging, in_phase),
        resonator_amplitude=resonator_amplitude,
        resonator_angle=resonator_angle,
        length_scale=length_scale,
        strength=velocity_amplitude / (length_scale * REFERENCE_FREQUENCY),
        velocity_amplitude=velocity_amplitude,
        ripple_amplitude=velocity_amplitude / frequency,
    )


def device_steady_velocity(device: Device, phase: float, load: float = 0.0) -> float:
    """Return the steady velocity of a device in m/s, (5) and (20) in dimensional form.

    ``phase`` in rad, ``load`` in N. Valid for equal frequencies of drive and normal load. Raises
    ValueError as ``equivalent_force`` does, for a device without vibration or with a contact that
    lifts, and for a load of at least the mean friction.
    """
    force = equivalent_force(device)
    if force.amplitude <= 0.0:
        raise ValueError(
            f"base_amplitude = {device.base_amplitude!r} m and tangential_force = "
            f"{device.tangential_force!r} N: (5) needs a vibration, one must differ from 0"
        )
    friction = device.mean_friction
    if not -friction < load < friction:
        raise ValueError(
            f"load = {load!r} N must lie between -{friction!r} and {friction!r} N, the mean "
            "friction: a greater load runs away"
        )
    lag, share = phase + force.angle, load / friction
    return loaded_velocity(force.velocity_amplitude, device.amplitude_ratio, lag, share)


def device_blocking_force(device: Device, phase: float) -> float:
    """Return the load in N that stops the motion, (22) for every friction face.

    (22) is for one face; the device of fig. 6 has two. Raises ValueError as ``equivalent_force``
    does and for a contact that lifts.
    """
    force = equivalent_force(device)
    return device.mean_friction * blocking_load(device.amplitude_ratio, phase + force.angle)


def check_strength(strength: float) -> None:
    """Raise ValueError unless the strength of the vibration is above 0."""
    if not strength > 0.0:
        raise ValueError(f"strength = {strength!r} must be greater than 0")


def check_never_lifts(amplitude_ratio: float) -> None:
    """Raise ValueError unless an amplitude ratio keeps the contact closed."""
    if not 0.0 <= amplitude_ratio <= 1.0:
        raise ValueError(
            f"amplitude_ratio = {amplitude_ratio!r} of the normal load must lie between 0 and 1: "
            "above 1 the contact lifts, which this closed form does not cover"
        )
