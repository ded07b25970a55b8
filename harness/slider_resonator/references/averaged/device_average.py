"""Averages of a device, dimensional: friction, steady velocity, blocking force; if they hold."""

import math
from collections.abc import Callable
from functools import partial

from slider_resonator.device.device import Device
from slider_resonator.references.averaged import averaged_coulomb, uniform_average
from slider_resonator.references.averaged.uniform_average import LugreCase
from slider_resonator.references.averaged.vibrating_contact import mean_load
from slider_resonator.references.equivalent_force import (
    RESONANCE_RESOLUTION,
    EquivalentForce,
    equivalent_force,
)

_SAMPLES = 65
"""Velocities between which equilibria are searched."""


def mean_friction(
    device: Device, force: EquivalentForce, velocity: float, lead: float, ratio: float
) -> float:
    """Return the mean friction in N at a slow velocity in m/s.

    ``lead`` in rad is how far the normal load is ahead of ``ratio`` times the base excitation; the
    phase counts only for an integer ratio. Raises ValueError for values out of bounds.
    """
    phase = lead + ratio * force.angle
    fast, scale = force.velocity_amplitude, device.friction_faces * device.normal_preload
    if device.friction_law == 0:
        share = averaged_coulomb.mean_friction(velocity, fast, device.amplitude_ratio, phase, ratio)
        return scale * device.friction_coefficient * share
    case = LugreCase(
        fast, device.amplitude_ratio, phase, device.friction_coefficient, device.bristle_damping
    )
    return scale * uniform_average.mean_friction(
        velocity, case, device.bristle_stiffness, device.drive_frequency, ratio
    )


def full_friction(device: Device, phase: float, ratio: float) -> float:
    """Return the mean friction in N of a block that slides without vibration, under either law.

    ``phase`` in rad is that of the normal load, which counts only at ratio 0.
    """
    load = mean_load(device.normal_preload, device.normal_amplitude, phase, ratio)
    return device.friction_faces * device.friction_coefficient * load


def steady_velocity(device: Device, phase: float, load: float, ratio: float) -> float:
    """Return the steady velocity in m/s, (5) and (20) for Coulomb friction at ratio 1.

    ``phase`` in rad relative to the base excitation, ``load`` in N. Raises ValueError for a device
    without vibration, as `fast_motion` does, and for a load that friction does not balance.
    """
    force = _vibration(device)
    friction = partial(mean_friction, device, force, lead=phase, ratio=ratio)
    return stable_velocity(friction, force.velocity_amplitude, load)


def blocking_force(device: Device, phase: float, ratio: float) -> float:
    """Return the load in N that stops a device; phase in rad relative to the base excitation.

    For Coulomb friction at ratio 1 it is (22), which is for one face, times the faces. Raises
    ValueError for a device without vibration and as `fast_motion` does.
    """
    return -mean_friction(device, _vibration(device), 0.0, phase, ratio)


def fast_motion(device: Device) -> EquivalentForce:
    """Return the motion that averages are over.

    Raises ValueError as `equivalent_force` does and for a device without friction.
    """
    if device.mean_friction <= 0.0:
        raise ValueError(
            f"mean friction = {device.mean_friction!r} N from friction_coefficient = "
            f"{device.friction_coefficient!r} and normal_preload = {device.normal_preload!r} N "
            "must be greater than 0: averages are in units of it"
        )
    return equivalent_force(device)


def _vibration(device: Device) -> EquivalentForce:
    force = fast_motion(device)
    if force.amplitude <= 0.0:
        raise ValueError(
            f"base_amplitude = {device.base_amplitude!r} m and tangential_force = "
            f"{device.tangential_force!r} N: averages need a vibration, one must differ from 0"
        )
    return force


def stable_velocity(friction: Callable[[float], float], strength: float, load: float) -> float:
    """Return the slow velocity within +-``strength`` that balances a load and is stable.

    ``friction`` is the averaged friction at a slow velocity, constant from +-strength on, ``load``
    in its unit. LuGre friction is not monotonic, so that a load above that of full sliding may be
    balanced, and at more than one velocity: the one farthest in the direction in which the slider
    leaves rest without load is returned, forward if it stays. Raises ValueError if there is none.
    """

    def excess(turn: float) -> float:
        return friction(strength * math.cos(turn)) + load

    turns = [math.pi * step / (_SAMPLES - 1) for step in range(_SAMPLES)]
    values = [excess(turn) for turn in turns]
    found = [
        strength * math.cos(_root(excess, turns[step], turns[step + 1]))
        for step in range(_SAMPLES - 1)
        if values[step] > 0.0 >= values[step + 1]  # friction grows with velocity
    ]
    if not found:
        raise ValueError(
            f"load = {load!r} is balanced at no velocity: friction lies between "
            f"{min(values) - load!r} and {max(values) - load!r}, a greater load runs away"
        )
    forward = friction(0.0) <= 1e-12 * max(map(abs, values))  # to rounding
    return max(found) if forward else min(found)


def _root(function: Callable[[float], float], left: float, right: float) -> float:
    """Return where a function falls through 0, by halving: scipy's takes longer to load."""
    while True:
        middle = 0.5 * (left + right)
        if middle in (left, right):
            return middle
        if function(middle) > 0.0:
            left = middle
        else:
            right = middle


def prediction_valid(device: Device, phase: float, load: float, ratio: float) -> bool:
    """Return whether steady velocity and blocking force of averaged theory apply.

    They do where the slider slides in both directions and does not run away: there is a steady
    vibration, the load is below the mean friction of sliding, and the vibration overcomes this
    friction by itself, on the free slider and on one that is held. ``phase`` (rad) is that of the
    normal force relative to the base excitation, ``load`` in N.
    """
    if not abs(load) < full_friction(device, phase, ratio):
        return False
    try:
        free = equivalent_force(device)
    except ValueError:
        return False
    # Of a vibration with the amplitude u bristles resist at most
    # faces N min(mu, |sigma_0 + i w sigma_1| u): what only bends them is not held.
    share = device.friction_coefficient
    if device.friction_law == 1:
        bristle = complex(device.bristle_stiffness, device.drive_frequency * device.bristle_damping)
        share = min(share, abs(bristle) * free.ripple_amplitude)
    normal = mean_load(device.normal_preload, device.normal_amplitude, phase, ratio)
    resistance = device.friction_faces * normal * share
    return min(free.amplitude, _force_on_held_slider(device)) > resistance


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
