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
from math import copysign, cos, pi, sin, tau

from .averaged_lugre import FastMotion, mean_friction
from .balance import Balance, Point, balanced_turning
from .bristle import bristle_of
from .device import Device, Inputs
from .motion import EPSILON
from .plant import equivalent_force
from .refusal import Refusal
from .vibrating_load import VibratingLoad


@dataclass(frozen=True, slots=True)
class Averaged:
    """Steady velocity [m/s] and blocking force [N] by averaged theory."""

    steady_velocity: float
    blocking_force: float


ROUNDING = 8.0
"""Rounding error of a mean friction, in units of the last place of the largest friction."""

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
    first, middle, last = friction(0.0), friction(0.5 * pi), friction(pi)
    if first == last:
        # Nothing holds the slider back: every velocity is steady, or with a load none.
        return Averaged(-copysign(fast.velocity, inputs.load) if inputs.load else 0.0, 0.0)
    opposing = inputs.load

    def excess(turning: float) -> float:
        return friction(turning) + opposing

    near: Callable[[float], float] = excess
    if not device.friction_law and load.wave_number and not load.lifts:
        near = _closed(device, inputs, delta)
    damping = device.bristle_damping * fast.velocity if device.friction_law else 0.0
    largest = device.friction_coefficient + damping
    normal = device.normal_preload + device.normal_amplitude
    noise = ROUNDING * EPSILON * device.friction_faces * largest * normal
    balance = Balance(excess, near, noise, rises=damping > device.friction_coefficient)
    turning = balanced_turning(
        balance,
        Point(0.0, first + opposing),
        Point(0.5 * pi, middle + opposing),
        Point(pi, last + opposing),
    )
    return Averaged(fast.velocity * cos(turning), -middle)


def _closed(device: Device, inputs: Inputs, delta: float) -> Callable[[float], float]:
    """Coulomb friction and load [N] without flight, as (20) has it."""
    scale = device.friction_faces * device.friction_coefficient
    ratio, opposing = inputs.frequency_ratio, inputs.load
    preload = scale * device.normal_preload
    swing = 2.0 * scale * device.normal_amplitude / (ratio * pi) * sin(delta)

    def excess(turning: float) -> float:
        return preload * (1.0 - 2.0 / pi * turning) - swing * sin(ratio * turning) + opposing

    return excess


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
