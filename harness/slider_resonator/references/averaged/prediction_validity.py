"""Whether averaged theory applies to a device: it slides in both directions and does not run away.

Three conditions: there is a steady vibration; the load is below the mean friction of sliding; and
the vibration overcomes this friction by itself, on the free slider and on one that is held. Against
LuGre friction a vibration of amplitude u [m] meets a force of at most
``faces N min(mu, |sigma_0 + i w sigma_1| u)``: what only bends the bristles is not held.
"""

from __future__ import annotations

import math

from slider_resonator.device.device import Device
from slider_resonator.references.averaged.vibrating_contact import mean_load
from slider_resonator.references.equivalent_force import RESONANCE_RESOLUTION, equivalent_force


def prediction_valid(device: Device, phase: float, load: float, ratio: float) -> bool:
    """Return whether steady velocity and blocking force of averaged theory apply.

    ``phase`` (rad) is that of the normal force relative to the base excitation, ``load`` in N.
    """
    normal = _mean_normal_force(device, phase, ratio)
    sliding = device.friction_faces * device.friction_coefficient * normal
    if not abs(load) < sliding:
        return False
    try:
        free = equivalent_force(device)
    except ValueError:
        return False
    held = _force_on_held_slider(device)
    return min(free.amplitude, held) > _resistance(device, normal, free.ripple_amplitude)


def _mean_normal_force(device: Device, phase: float, ratio: float) -> float:
    """Return the normal force (N) averaged over the phases that it takes, one at ratio 0."""
    if ratio == 0.0:
        return max(0.0, device.normal_preload + device.normal_amplitude * math.sin(phase))
    if device.normal_preload == 0.0:
        return device.normal_amplitude / math.pi
    return device.normal_preload * mean_load(device.amplitude_ratio)


def _resistance(device: Device, normal: float, amplitude: float) -> float:
    """Return the largest friction (N) that a vibration of this amplitude (m) meets."""
    share = device.friction_coefficient
    if device.friction_law == 1:
        bristle = complex(device.bristle_stiffness, device.drive_frequency * device.bristle_damping)
        share = min(share, abs(bristle) * amplitude)
    return device.friction_faces * normal * share


def _force_on_held_slider(device: Device) -> float:
    """Return the amplitude (N) of what spring, damper and direct drive exert on a held slider.

    It is a steady amplitude of exp(i w t) that solves (27), infinite for undamped resonance.
    """
    w, m = device.drive_frequency, device.resonator_mass
    coupling = complex(device.stiffness, w * device.damping)
    resonance = abs(device.resonator_frequency**2 - w * w)
    if device.damping_ratio == 0.0 and resonance <= RESONANCE_RESOLUTION * w * w:
        return math.inf
    displacement = m * device.base_amplitude * w * w / (coupling - m * w * w) if m else 0.0
    return abs(coupling * displacement + device.tangential_force)
