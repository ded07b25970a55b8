"""Estimates of the error that averages make in the slow velocity."""

from __future__ import annotations

from math import hypot, inf, pi, sqrt, tau

from .bristle import bristle_of
from .device import Device
from .fast_vibration import FastVibration
from .motion import State
from .plant import Plant
from .velocity_scale import velocity_scale

FIRST_ORDER = 2.0
"""Error of first order in friction shares and v_q: of the average, and of what the average leaves
out, the resonator's first swing and the first bend of bristles."""

STIFF = 0.8
"""Error of second order in squares of the friction share and v_q, with a resonator that is stiff
against the drive."""

SOFT = 5.0
"""The same with a soft one."""

BY_DAMPING = 6.0
"""How much more that is by the square of the damping ratio."""

BY_FLIGHT = 2.0
"""Factor of it under a contact that lifts."""

DRIFTING = 0.6
"""Error under a lead that drifts, in v_q and the share of friction that varies: by the drift over
the drive frequency, as the motion within a turn then belongs to no orbit."""

LAGGING = 0.3
"""The same by the lag of the resonator and the friction share in a beat."""

LAGGING_ON_AVERAGE = 0.015
"""The same by that lag and the drift on an average of beats."""

ADDED_MASS = 0.5
"""Error of second order in squares of the added mass and v_q."""

STIFF_UP_TO = 1.5
"""Drive frequency over resonator frequency up to which the resonator counts as stiff."""

SOFT_FROM = 3.0
"""The same from which on it counts as soft."""

SHARE_OF_TOLERANCE = 0.01
"""Share of the tolerance of LuGre friction that tables may err by, where it is more than
`RESOLUTION`."""

RESOLUTION = 1e-9
"""Error of the tables, in v_q."""

ROUNDING = 1e-14
"""Error of resolved motion by rounding, in its scale of velocities."""

RESOLVED_AT_ONCE = 0.03
"""Its error in tolerances of LuGre friction and that scale: that of a moment."""

RESOLVED_IN_TURN = 2.5e-3
"""The same of a turn, which adds up for some decays of the slow motion."""

DECAYS = 3.0
"""How many: far from balance the slow motion decays later."""

LEAST_BY_RULE = 1e-8
"""The least error that the rule of thumb gives, in v_q."""


def friction_share(device: Device, fast: FastVibration) -> float:
    """Share of friction in the inertia of the vibration, faces mu N0 / (Mt w v_q).

    It is the small number by which averages expand. What bristles damp while they bend counts, too.
    """
    normal = max(device.normal_preload, device.normal_amplitude / pi)
    friction = device.friction_faces * device.friction_coefficient * normal
    friction *= hypot(1.0, damping_of_bend(device, fast))
    return friction / (device.total_mass * device.drive_frequency * fast.velocity)


def damping_of_bend(device: Device, fast: FastVibration) -> float:
    """Damping of bristles over Coulomb friction; 0 without bristles.

    A bristle bends over a path of 2 mu/s0 after each of two reversals in a turn, and damps by the
    impulse of 2 mu s1/s0 per normal load; but by no more than s1 v_q all the time.
    """
    if device.friction_law == 0:
        return 0.0
    bristle = bristle_of(device)
    all_time = bristle.damping * fast.velocity / bristle.coefficient
    bends = 2.0 / pi * bristle.damping / bristle.stiffness * device.drive_frequency
    return min(all_time, bends)


def slow_decay_in_turn(device: Device, fast: FastVibration) -> float:
    """Decay of the slow motion in a turn of the drive."""
    return 4.0 * friction_share(device, fast)


def decay_in_turn(device: Device) -> float:
    """Decay of the resonator's own vibration in a turn of the drive, the slower of two.

    It is infinite without resonator.
    """
    if device.resonator_mass == 0.0:
        return inf
    free_share = device.slider_mass / device.total_mass
    wn = device.resonator_frequency
    decay = device.damping_ratio * wn / free_share
    excess = decay * decay - wn * wn / free_share
    slower = wn * wn / free_share / (decay + sqrt(excess)) if excess > 0.0 else decay
    return slower * tau / device.drive_frequency


def bristle_decay(device: Device, fast: FastVibration) -> float:
    """Decay of the bend of a bristle in a turn: over a path of four times the amplitude.

    It is infinite without bristles.
    """
    if device.friction_law == 0:
        return inf
    bristle = bristle_of(device)
    path = 4.0 * fast.velocity / device.drive_frequency
    return bristle.stiffness * path / bristle.coefficient


def first_order_error(device: Device, fast: FastVibration) -> float:
    """Error [m/s] of averages of first order."""
    share = friction_share(device, fast) if fast.velocity > 0.0 else 0.0
    if not share > 0.0:
        return 0.0
    decay = min(decay_in_turn(device), bristle_decay(device, fast))
    swing = 1.0 + (1.0 / decay if decay > 0.0 else inf)
    return min(FIRST_ORDER * share * swing, 1.0) * fast.velocity


def second_order_error(
    device: Device, fast: FastVibration, added_mass: float, force: float
) -> float:
    """Error [m/s] of averages of second order, by rule of thumb.

    Friction adds a share `added_mass`, and friction and load leave a mean `force` [N]: without it
    motion is steady, and its orbit exact.
    """
    share = friction_share(device, fast)
    inertia = device.total_mass * device.drive_frequency * fast.velocity
    away = min(abs(force) / (share * inertia), 1.0) if share > 0.0 else 0.0
    tuning = device.drive_frequency / device.resonator_frequency
    soft = min(max((tuning - STIFF_UP_TO) / (SOFT_FROM - STIFF_UP_TO), 0.0), 1.0)
    damping = min(device.damping_ratio, 1.0)
    sensitivity = (STIFF + soft * (SOFT - STIFF)) * (1.0 + BY_DAMPING * damping * damping)
    if device.normal_amplitude > device.normal_preload:
        sensitivity *= BY_FLIGHT
    squares = sensitivity * share * share + ADDED_MASS * added_mass * added_mass
    return min(away * squares + LEAST_BY_RULE, 1.0) * fast.velocity


def _resonator_lag(device: Device) -> float:
    """The change of the slider's vibration by a change of friction, which the resonator delays.

    Its delay in radians of the drive, and its amplitude over that of the pair as one mass. Both are
    large near the free resonance of the pair.
    """
    w, wn = device.drive_frequency, device.resonator_frequency
    ratio = device.resonator_mass / device.slider_mass
    stiffness = (1.0 + ratio) * wn * wn
    damping = 2.0 * device.damping_ratio * (1.0 + ratio) * wn * w
    detuned = stiffness - w * w
    return ratio * w * w * (stiffness + w * w) / (detuned * detuned + damping * damping)


def drift_error(device: Device, fast: FastVibration, drift: float) -> float:
    """What averages of second order err by besides [m/s], by rule of thumb.

    The lead drifts by `drift` >= 0 [rad/s] over all turns of an orbit.
    """
    if drift == 0.0:
        return 0.0
    share, turned = friction_share(device, fast), drift / device.drive_frequency
    lifts = device.normal_amplitude > device.normal_preload
    varying = 1.0 if lifts else device.normal_amplitude / device.normal_preload
    # The velocity follows a phase slower than itself, and leaves the lag behind.
    faster = turned / (turned + slow_decay_in_turn(device, fast) / tau)
    lag = _resonator_lag(device) * (BY_FLIGHT if lifts else 1.0)
    lagging = LAGGING * faster * share + LAGGING_ON_AVERAGE * varying * turned
    return min(varying * share * (DRIFTING * turned + lag * lagging), 1.0) * fast.velocity


def table_accuracy(device: Device) -> float:
    """Error of tables in the scale of each quantity.

    It is that up to which the last coefficients of a panel are left.
    """
    if device.friction_law == 0:
        return RESOLUTION
    return max(RESOLUTION, SHARE_OF_TOLERANCE * device.tolerance)


def resolution_error(device: Device, fast: FastVibration) -> float:
    """Error [m/s] of the tables."""
    return table_accuracy(device) * fast.velocity


def resolved_error(resolved: Device, plant: Plant, fast: FastVibration, angle: float) -> float:
    """Error [m/s] of resolved motion after a drive angle [rad]."""
    turns = min(angle / tau, DECAYS / slow_decay_in_turn(resolved, fast))
    share = ROUNDING
    if resolved.friction_law != 0:
        share += (RESOLVED_AT_ONCE + RESOLVED_IN_TURN * turns) * resolved.tolerance
    swing = abs(fast.resonator) * resolved.drive_frequency
    return share * velocity_scale(plant, State(fast.velocity, 0.0, swing))
