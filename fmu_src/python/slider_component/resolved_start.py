"""For how long motion has to be resolved until what shook the resonator has decayed."""

from __future__ import annotations

from math import ceil, hypot, log, pi, tau

from .device import Device
from .fast_vibration import FastVibration, steady_swing
from .motion import State
from .slow_motion_error import bristle_decay, decay_in_turn

SWING_LEFT = 1e-7
"""What may be left of the swing, over the steady one, and of the bend of a bristle."""

LAG_LEFT = 1e-9
"""What may be left of a lag, over v_q."""

MAX_TURNS_RESOLVED = 1e5
"""Most turns of the drive."""

MIN_TURNS_RESOLVED = 8.0
"""Fewest turns: from rest under a direct drive motion begins where the slider just turns back, and
its friction is not slow until it has left that velocity."""

MAX_SWING = 1e6
"""Largest swing, over the steady one, that counts."""


def resolved_is_bounded(device: Device, fast: FastVibration) -> bool:
    """Whether the vibration decays at all, in a number of turns that can be resolved."""
    decay = min(decay_in_turn(device), bristle_decay(device, fast))
    return decay * MAX_TURNS_RESOLVED > log(MAX_SWING / SWING_LEFT)


def resolved_angle(device: Device, fast: FastVibration, state: State, theta: float) -> float:
    """Drive angle [rad], whole turns, from a state at drive phase `theta` [rad] on.

    After it the resonator's swing is the steady one, and the bend of a bristle the periodic one.
    """
    w, apart = device.drive_frequency, 0.0
    if device.resonator_mass > 0.0:
        displacement, rate = steady_swing(fast.resonator, theta, w)
        size = max(abs(fast.resonator), fast.velocity / w)
        apart = hypot(state.displacement - displacement, (state.rate - rate) / w) / size
    swing = _angle_until(min(apart, MAX_SWING), SWING_LEFT, decay_in_turn(device))
    bend = _angle_until(1.0, SWING_LEFT, bristle_decay(device, fast))
    return max(tau * MIN_TURNS_RESOLVED, swing, bend)


def swing_by_inertia(device: Device) -> float:
    """How far the resonator lags behind an acceleration by its inertia alone [s^2]."""
    return 1.0 / device.resonator_frequency**2 if device.resonator_mass > 0.0 else 0.0


def velocity_of_swing(device: Device, swing: float) -> float:
    """What a swing [m] of the resonator adds at most to the slider's mean velocity [m/s]."""
    share = device.resonator_mass / device.total_mass
    return share * swing * device.drive_frequency / pi


def lag_angle(device: Device, fast: FastVibration, added_mass: float) -> float:
    """The same after friction has changed while it adds a share `added_mass` of the total mass."""
    decay = min(decay_in_turn(device), bristle_decay(device, fast))
    return _angle_until(added_mass * added_mass, LAG_LEFT, decay)


def _angle_until(size: float, left: float, decay: float) -> float:
    """Drive angle [rad] until a `size` has become `left` at a decay in a turn."""
    return tau * ceil(log(size / left) / decay) if size > left else 0.0
