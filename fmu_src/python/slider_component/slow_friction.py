"""Mean friction under fast vibration, as slow motion sees it: at a slow velocity and a slow phase.

The normal load counts with its phase near integer frequency ratios n, where that phase drifts by
(ratio - n) w (Appendix A for n = 1), and with its mean elsewhere. A load that lifts the contact has
harmonics, and counts with its phase near fractions too. LuGre friction is that of the
periodic bristle response, uniform in the bristle stiffness.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from math import acos, cos, pi, sin, tau
from typing import NamedTuple

from .averaged_lugre import FastMotion, mean_friction
from .bristle import Bristle, bristle_of
from .device import Device, Inputs
from .fast_vibration import FastVibration
from .friction_table import MOST_WAVES_TABULATED, FrictionTable, friction_table
from .vibrating_load import VibratingLoad, turns_to_repeat

NEAR = 0.1
"""Distance of the frequency ratio from an integer up to which the phase counts as slow; under a
lifting contact that of q times the ratio, times q, for q of a few turns."""

Friction = Callable[[float, float], float]
"""Time t [s] from now and slow velocity [m/s] -> mean friction [N] of all faces."""


class SlowFriction(NamedTuple):
    """The mean friction `at` a time and velocity, which depends on time where `drift` is not 0.

    `drift` [rad/s] is that of the phase of the normal load, and `over_flight` tells whether each
    value costs a quadrature over flight.
    """

    at: Friction
    drift: float
    over_flight: bool = False


def slow_friction(
    device: Device, inputs: Inputs, fast: FastVibration, theta: float, psi: float
) -> SlowFriction:
    """The mean friction from drive phase `theta` and normal phase `psi` [rad] on."""
    ratio = inputs.frequency_ratio
    turns = turns_to_repeat(device, ratio, NEAR)
    waves = round(turns * ratio) / turns if turns else ratio
    drift = (ratio - waves) * device.drive_frequency
    phase = inputs.phase + psi - waves * theta + waves * fast.lag
    lifts = device.normal_amplitude > device.normal_preload
    # The waves of a sine in a turn of the drive; 0 where it averages out, or stands still.
    n = int(waves) if turns == 1 else 0
    # Without vibration a slaved bristle is always fully bent, and its friction Coulomb's.
    if device.friction_law == 0 or fast.velocity == 0.0:
        if n != 0 and not lifts:
            return SlowFriction(_coulomb(device, fast.velocity, n, phase, drift), drift)
        coulomb = _coulomb_over_flight(device, fast.velocity, waves, phase, drift)
        return SlowFriction(coulomb, drift)
    if turns is None or waves == 0.0:
        mean = _lugre_under_mean_load(device, fast.velocity, waves, phase, drift)
        return SlowFriction(mean, drift)
    if lifts or abs(n) > MOST_WAVES_TABULATED:
        lugre = _lugre_over_flight(device, fast.velocity, waves, phase, drift)
        return SlowFriction(lugre, drift, over_flight=True)
    return SlowFriction(_lugre(device, fast.velocity, n, phase, drift), drift)


def _coulomb(device: Device, fast_velocity: float, n: int, phase: float, drift: float) -> Friction:
    scale = device.friction_faces * device.friction_coefficient
    preload = scale * device.normal_preload
    swing = 2.0 * scale * device.normal_amplitude / (n * pi)

    def friction(t: float, velocity: float) -> float:
        turning = _turning(velocity, fast_velocity)
        steady = preload * (1.0 - 2.0 / pi * turning)
        return steady - swing * sin(n * turning) * sin(phase + drift * t)

    return friction


def _coulomb_over_flight(
    device: Device, fast_velocity: float, waves: float, phase: float, drift: float
) -> Friction:
    scale = device.friction_faces * device.friction_coefficient / tau

    def friction(t: float, velocity: float) -> float:
        turning = _turning(velocity, fast_velocity)
        load = VibratingLoad(device, waves, phase + drift * t)
        forward = load.integral(turning, tau - turning)
        return scale * (forward - load.integral(-turning, turning))

    return friction


def _lugre(device: Device, fast_velocity: float, n: int, phase: float, drift: float) -> Friction:
    means_at = _table(device, fast_velocity, n).at
    preload = device.friction_faces * device.normal_preload
    swing = device.friction_faces * device.normal_amplitude

    def friction(t: float, velocity: float) -> float:
        plain, sine, cosine = means_at(_turning(velocity, fast_velocity))
        delta = phase + drift * t
        return preload * plain + swing * (cos(delta) * sine + sin(delta) * cosine)

    return friction


def _lugre_under_mean_load(
    device: Device, fast_velocity: float, waves: float, phase: float, drift: float
) -> Friction:
    means_at = _table(device, fast_velocity, 1).at
    scale = device.friction_faces / tau

    def friction(t: float, velocity: float) -> float:
        load = VibratingLoad(device, waves, phase + drift * t).integral(0.0, tau)
        return scale * load * means_at(_turning(velocity, fast_velocity))[0]

    return friction


def _lugre_over_flight(
    device: Device, fast_velocity: float, waves: float, phase: float, drift: float
) -> Friction:
    bristle = bristle_of(device)
    fast = FastMotion(fast_velocity, device.drive_frequency)

    def friction(t: float, velocity: float) -> float:
        load = VibratingLoad(device, waves, phase + drift * t)
        turning = _turning(velocity, fast_velocity)
        return device.friction_faces * mean_friction(bristle, fast, load, turning)

    return friction


def _table(device: Device, fast_velocity: float, n: int) -> FrictionTable:
    return _tabulated(
        device.friction_coefficient,
        device.bristle_stiffness,
        device.bristle_damping,
        fast_velocity,
        device.drive_frequency,
        n,
    )


@lru_cache(maxsize=4)
def _tabulated(
    coefficient: float,
    stiffness: float,
    damping: float,
    fast_velocity: float,
    frequency: float,
    n: int,
) -> FrictionTable:
    bristle = Bristle(coefficient, stiffness, damping)
    return friction_table(bristle, FastMotion(fast_velocity, frequency), n)


def _turning(velocity: float, fast_velocity: float) -> float:
    """Angle tau at which sliding turns forward; 0 or pi once it no longer turns."""
    if abs(velocity) >= fast_velocity:
        return 0.0 if velocity > 0.0 else pi
    return acos(velocity / fast_velocity)
