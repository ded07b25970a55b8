"""How far averaged motion of second order may be off the resolved motion of the full device.

Compared are the velocity and position of slider and resonator as one mass, X' + r Y' and X + r Y:
the resonator's own swing does not move them.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import hypot, inf, pi

from slider_resonator.arrays import Array
from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.averaged.averaged_motion import MAX_DETUNING
from slider_resonator.references.averaged.vibrating_contact import turns_until_repeat
from slider_resonator.references.closed_forms import equivalent_force

CENTRE_VELOCITY, CENTRE = "centre velocity", "centre"
MARGIN = 3.0
"""Largest error over what an FMU and the theory say of it."""
LAG = 10.0
"""Lag of the motion within a period behind the held orbit, in squares of the friction share."""
LAG_ANGLE = 10.0
"""Angle (rad) of the drive in which a lag of the velocity becomes one of the position."""
UNKNOWN = 0.999
"""Estimate over the amplitude of the vibration from which on it says that the error is unknown."""


@dataclass(frozen=True)
class Lag:
    """Error of the theory, m/s; `fast_velocity` (m/s) is the amplitude of the vibration."""

    velocity: float
    fast_velocity: float

    @property
    def share(self) -> float:
        """The error over the amplitude."""
        return self.velocity / self.fast_velocity


def lag_of(device: Device, held: Sequence[HeldInputs]) -> Lag:
    """Return how far motion may lag behind held orbits.

    It does by squares of the friction share, and under a phase that drifts by the product with the
    drift. Raises ValueError for a device without vibration, or with an undamped one at resonance.
    """
    lag = fast = 0.0
    for inputs in held:
        tuned = inputs.tuned_device(device)
        force = equivalent_force(tuned)
        friction = _mean_friction(tuned, force.velocity_amplitude)
        share = friction / abs(force.amplitude) if force.amplitude else inf
        drift = _detuning(tuned, inputs.frequency_ratio)
        lag = max(lag, share * (LAG * share + drift) * force.velocity_amplitude)
        fast = max(fast, force.velocity_amplitude)
    if not fast > 0.0:
        raise ValueError("a device without vibration has no held orbits")
    return Lag(lag, fast)


def allowed_off(device: Device, lag: Lag, estimate: float, duration: float) -> Mapping[str, float]:
    """Return the allowed error of both signals, besides that of the reference, in m/s and m.

    `estimate` (m/s) is what the FMU says of it: its largest slow_motion_error.
    """
    velocity = MARGIN * (estimate + lag.velocity)
    if estimate >= UNKNOWN * lag.fast_velocity:
        velocity = inf
    travel = velocity * (duration + LAG_ANGLE / device.drive_frequency)
    return {CENTRE_VELOCITY: velocity, CENTRE: travel}


def centre_signals(device: Device, signals: Mapping[str, Array]) -> dict[str, Array]:
    """Return velocity (m/s) and position (m) of slider and resonator as one mass, shape (n,)."""
    share = device.mass_ratio
    return {
        CENTRE_VELOCITY: signals["velocity"] + share * signals["resonator_velocity"],
        CENTRE: signals["position"] + share * signals["resonator_displacement"],
    }


def _mean_friction(device: Device, fast_velocity: float) -> float:
    """Return the friction of sliding, with what bristles damp as they bend, in N."""
    normal = max(device.normal_preload, device.normal_amplitude / pi)
    damping = 0.0
    if device.friction_law == 1 and device.friction_coefficient > 0.0:
        full = device.bristle_damping * fast_velocity / device.friction_coefficient
        bend = 2.0 * device.drive_frequency / (pi * device.bristle_stiffness)
        damping = min(full, device.bristle_damping * bend)
    return device.friction_faces * device.friction_coefficient * normal * hypot(1.0, damping)


def _detuning(device: Device, ratio: float) -> float:
    """Return how far the ratio is from one with a phase that stands, 0 without modulated load."""
    if device.normal_amplitude == 0.0:
        return 0.0
    share = device.normal_amplitude / device.normal_preload if device.normal_preload else inf
    turns = turns_until_repeat(share, ratio, MAX_DETUNING) or 1
    return abs(ratio - round(turns * ratio) / turns)
