"""The single tangential force that stands for the resonator, (30)-(34)."""

import cmath
from dataclasses import dataclass

from slider_resonator.device.device import Device

RESONANCE_RESOLUTION = 1e-12
"""Response of an undamped resonator, over that far below resonance, that is rounding."""


@dataclass(frozen=True)
class EquivalentForce:
    """The steady vibration of a device without friction, SI units.

    The slider of mass M + m obeys (33) with force ``amplitude * sin(w t - angle)``, F_T* and
    theta1. The resonator moves as ``resonator_amplitude * sin(w t - resonator_angle)``, Y0 and
    theta of (32). The slider's fast velocity has the amplitude F_T* / ((M + m) w), its fast
    displacement, the ripple, F_T* / ((M + m) w^2).
    """

    amplitude: float
    angle: float
    resonator_amplitude: float
    resonator_angle: float
    velocity_amplitude: float
    ripple_amplitude: float


def equivalent_force(device: Device) -> EquivalentForce:
    """Return the equivalent single-degree-of-freedom force of a device, (30)-(34).

    A direct drive ``tangential_force * sin(w t)`` is included: it adds to F_T* and drives the
    resonator through the slider. Raises ValueError as `steady_vibration` does.
    """
    resonator, force = steady_vibration(device)
    velocity = abs(force) / (device.total_mass * device.drive_frequency)
    return EquivalentForce(
        amplitude=abs(force),
        angle=-cmath.phase(force),
        resonator_amplitude=abs(resonator),
        resonator_angle=-cmath.phase(resonator),
        velocity_amplitude=velocity,
        ripple_amplitude=velocity / device.drive_frequency,
    )


def steady_vibration(device: Device) -> tuple[complex, complex]:
    """Return the complex amplitudes of the resonator (m), (32), and of the force (N) in (33).

    The drive is the imaginary part of exp(i theta), and friction does not act. Raises ValueError
    for an undamped resonator at its slipping resonance.
    """
    frequency = device.drive_frequency
    base_acceleration = device.base_amplitude * frequency**2
    share = device.slider_mass / device.total_mass
    response = complex(
        device.resonator_frequency**2 - share * frequency**2,
        2.0 * device.damping_ratio * device.resonator_frequency * frequency,
    )
    if abs(response) <= RESONANCE_RESOLUTION * frequency**2:
        raise ValueError(
            f"damping_ratio = {device.damping_ratio!r} at resonator_frequency = "
            f"{device.resonator_frequency!r} rad/s, the slipping resonance: there is no steady "
            "state; damping_ratio must be greater than 0 or the frequencies differ"
        )
    direct = device.tangential_force / device.total_mass
    resonator = (share * base_acceleration - direct) / response
    force = (
        device.resonator_mass * base_acceleration
        + device.tangential_force
        + device.resonator_mass * frequency**2 * resonator
    )
    return resonator, force
