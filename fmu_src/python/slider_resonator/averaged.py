"""Averaged motion under fast vibration, for any frequency ratio and for lifting contact.

The fast velocity of the slider is V - v_q cos(tau) with tau = theta - theta_1, so that it slides
forward while tau is in (Theta, 2 pi - Theta), cos(Theta) = V / v_q. With n = frequency_ratio an
integer, the normal load is N(n tau + delta) and the mean friction is an elementary integral over
those two arcs (eq. 4 for n = 1 without flight). At any other ratio all phases are met and the
mean load counts. Friction averaged so is accurate to the order of 1 / Omega.
"""

from __future__ import annotations

from cmath import phase as argument
from collections.abc import Callable
from dataclasses import dataclass
from math import copysign, cos, pi, tau

from .averaged_lugre import FastMotion, mean_friction
from .bristle import bristle_of
from .device import Device, Inputs
from .plant import equivalent_force
from .refusal import Refusal
from .vibrating_load import VibratingLoad


@dataclass(frozen=True, slots=True)
class Averaged:
    """Steady velocity [m/s] and blocking force [N] by averaged theory."""

    steady_velocity: float
    blocking_force: float


ITERATIONS = 52

NO_VIBRATION = Averaged(0.0, 0.0)


def averaged(device: Device, inputs: Inputs, normal_lead: float) -> Averaged:
    """Averaged theory at the present inputs (eqs 20-22 with both faces; LuGre for any bristle).

    `normal_lead` [rad] is psi - n theta: what earlier changes of the ratio have left of it. Where
    the load exceeds full friction the velocity is the limit v_q of the theory, with its sign; both
    are 0 without vibration, and where undamped resonance leaves no steady vibration.
    """
    try:
        force = equivalent_force(device)
    except Refusal:
        return NO_VIBRATION
    if force == 0.0:
        return NO_VIBRATION
    fast = FastMotion(
        abs(force) / (device.total_mass * device.drive_frequency), device.drive_frequency
    )
    delta = inputs.phase + normal_lead - inputs.frequency_ratio * argument(force)
    load = VibratingLoad(device, inputs.frequency_ratio, delta)
    friction = _lugre(device, fast, load) if device.friction_law else _coulomb(device, load)
    if friction(0.0) == friction(pi):
        # Nothing holds the slider back: every velocity is steady, or with a load none.
        return Averaged(-copysign(fast.velocity, inputs.load) if inputs.load else 0.0, 0.0)
    low, high = 0.0, pi
    for _ in range(ITERATIONS):
        middle = 0.5 * (low + high)
        if friction(middle) + inputs.load > 0.0:
            low = middle
        else:
            high = middle
    return Averaged(fast.velocity * cos(0.5 * (low + high)), -friction(0.5 * pi))


def _coulomb(device: Device, load: VibratingLoad) -> Callable[[float], float]:
    """Mean friction [N] when sliding turns forward at tau = Theta [rad]; it never rises."""
    scale = device.friction_faces * device.friction_coefficient / tau

    def friction(turning: float) -> float:
        forward = load.integral(turning, tau - turning)
        return scale * (forward - load.integral(-turning, turning))

    return friction


def _lugre(device: Device, fast: FastMotion, load: VibratingLoad) -> Callable[[float], float]:
    bristle = bristle_of(device)

    def friction(turning: float) -> float:
        return device.friction_faces * mean_friction(bristle, fast, load, turning)

    return friction
