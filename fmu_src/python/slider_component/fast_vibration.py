"""The steady vibration of slider and resonator without friction, in closed form (32)-(34)."""

from __future__ import annotations

from cmath import phase as argument
from dataclasses import dataclass
from math import cos, sin

from .device import Device
from .plant import equivalent_force, steady_resonator


@dataclass(frozen=True, slots=True)
class FastVibration:
    """Velocity amplitudes [m/s], lag theta_1 [rad], and the resonator's complex amplitude of e [m].

    `velocity` is v_q of the slider, `pair_velocity` the one that the drive force gives to the pair.
    """

    velocity: float
    pair_velocity: float
    lag: float
    resonator: complex


def fast_vibration(device: Device) -> FastVibration:
    """Raises Refusal where undamped resonance leaves no steady vibration."""
    w, total = device.drive_frequency, device.total_mass
    force = equivalent_force(device)
    pair = device.resonator_mass * device.base_amplitude * w * w + device.tangential_force
    return FastVibration(
        abs(force) / (total * w), pair / (total * w), -argument(force), steady_resonator(device)
    )


def steady_swing(amplitude: complex, theta: float, frequency: float) -> tuple[float, float]:
    """Displacement [m] and velocity [m/s] of amplitude e at drive phase `theta` [rad]."""
    real, imag = amplitude.real, amplitude.imag
    return (
        real * sin(theta) + imag * cos(theta),
        frequency * (real * cos(theta) - imag * sin(theta)),
    )
