"""How long motion must be resolved: until the transient of the resonator has decayed."""

from __future__ import annotations

from math import ceil, hypot, log, pi, tau

from .device import Device
from .fast_vibration import FastVibration, steady_swing
from .motion import State
from .oscillator import free_response
from .plant import slip_oscillator
from .slow_motion_error import bristle_decay, decay_in_turn, friction_share

RESOLVED_TOLERANCE = 1e-9
"""Largest tolerance of LuGre friction with which motion is resolved before it goes over to orbits.

What it errs by stays in the slow velocity. Turns are few, so that costs little."""

SWING_LEFT = 1e-7
"""Relative size to which the transients of resonator and bristle must have decayed."""

LAG_LEFT = 1e-9
"""Size, over v_q, to which a lag must have decayed."""

MAX_TURNS_RESOLVED = 1e5
"""Largest number of turns of the drive that are resolved."""

MIN_TURNS_RESOLVED = 8.0
"""Smallest number of turns that are resolved: from rest under a direct drive the motion begins at
grazing, and its mean friction is not smooth until it has left that velocity."""

MAX_SWING = 1e6
"""Limit of the transient, relative to the steady vibration."""

BY_FRICTION = 4.0
"""Change of slow velocity by friction, over that of the slider's vibration by a swing: that of mean
friction in a turn at 0.7 of the fast velocity, as long as it lasts."""


def resolved_is_bounded(device: Device, fast: FastVibration) -> bool:
    """Whether transients decay within the largest number of turns that are resolved."""
    decay = min(decay_in_turn(device), bristle_decay(device, fast))
    return decay * MAX_TURNS_RESOLVED > log(MAX_SWING / SWING_LEFT)


def resolved_angle(device: Device, fast: FastVibration, state: State, theta: float) -> float:
    """Drive angle [rad], whole turns, until resonator and bristle have become periodic.

    It is counted from a state at drive phase `theta` [rad].
    """
    w, apart = device.drive_frequency, 0.0
    if device.resonator_mass > 0.0:
        displacement, rate = steady_swing(fast.resonator, theta, w)
        size = max(abs(fast.resonator), fast.velocity / w)
        apart = hypot(state.displacement - displacement, (state.rate - rate) / w) / size
    swing = _angle_until(min(apart, MAX_SWING), SWING_LEFT, decay_in_turn(device))
    bend = bend_angle(bristle_decay(device, fast))
    return max(tau * MIN_TURNS_RESOLVED, swing, bend)


def min_bend_decay(device: Device, fast: FastVibration) -> float:
    """Smallest decay of the bend of a bristle in a turn.

    Two multipliers that are separate share their decay, and the slow motion has less than half.
    """
    return 0.5 * bristle_decay(device, fast)


def bend_is_slow(device: Device, fast: FastVibration) -> bool:
    """Whether the bend may take longer to decay than the smallest angle that is resolved."""
    return bend_angle(min_bend_decay(device, fast)) > tau * MIN_TURNS_RESOLVED


def bend_angle(decay: float) -> float:
    """Drive angle [rad] until the bend has decayed whose `decay` in a turn is known."""
    return _angle_until(1.0, SWING_LEFT, decay)


def swing_by_inertia(device: Device) -> float:
    """How far the resonator lags behind an acceleration by its inertia alone [s^2]."""
    return 1.0 / device.resonator_frequency**2 if device.resonator_mass > 0.0 else 0.0


def velocity_of_swing(device: Device, swing: float) -> float:
    """What a swing [m] of the resonator adds at most to the slider's mean velocity [m/s]."""
    share = device.resonator_mass / device.total_mass
    return share * swing * device.drive_frequency / pi


def velocity_by_friction(device: Device, fast: FastVibration, swing: float) -> float:
    """Change of slow velocity [m/s] by the friction that a free swing [m] changes in all."""
    velocity = pi * velocity_of_swing(device, swing)
    if not velocity > 0.0:
        return 0.0
    return velocity * BY_FRICTION * friction_share(device, fast) / _apart_in_turn(device)


def velocity_of_free_swing(device: Device, fast: FastVibration, swing: float) -> float:
    """What a free swing adds at most to mean velocity.

    By what differs of it a turn later, and by friction.
    """
    within = 0.5 * velocity_of_swing(device, swing) * _apart_in_turn(device)
    return within + velocity_by_friction(device, fast, swing)


def _apart_in_turn(device: Device) -> float:
    """How far a free swing of the resonator is from itself a turn later, over its size."""
    w, slip = device.drive_frequency, slip_oscillator(device)
    cosine, sine = free_response(slip, tau / w)
    return hypot(cosine + slip.decay * sine - 1.0, w * sine)


def lag_angle(device: Device, fast: FastVibration, added_mass: float) -> float:
    """The same after a change of friction, which adds the share `added_mass` to the total mass."""
    decay = min(decay_in_turn(device), bristle_decay(device, fast))
    return _angle_until(added_mass * added_mass, LAG_LEFT, decay)


def _angle_until(size: float, left: float, decay: float) -> float:
    """Drive angle [rad], whole turns, in which `size` decays to `left`; `decay` is per turn."""
    return tau * ceil(log(size / left) / decay) if size > left else 0.0
