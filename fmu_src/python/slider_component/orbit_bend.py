"""The bend of a bristle that friction slows down.

By it motion differs from an orbit until it has decayed. By itself a bend decays over the path of
the slider. Where that is hardly faster than the slow motion, the two share their decay: the bend's
is that of the fast multiplier of an orbit.
"""

from __future__ import annotations

from math import exp, inf, isinf, log, tau

from .device import Device
from .fast_vibration import FastVibration
from .held_orbit import NoOrbitError, held_orbit_at, held_orbit_linearised
from .moment import Moment
from .period_map import PeriodMap
from .resolved_start import bend_is_slow, min_bend_decay
from .slow_motion_error import friction_share


def orbit_bend_decay(
    period_map: PeriodMap, fast: FastVibration, lead: float, moment: Moment
) -> float:
    """Decay of the bend in a turn, on the orbits at `lead` [rad] next to a moment.

    Infinite where it is fast by itself, and where there is no orbit.
    """
    if not bend_is_slow(period_map.held.device, fast):
        return inf
    velocity = period_map.momentum_velocity(moment.state, moment.theta)
    try:
        orbit = held_orbit_linearised(period_map, held_orbit_at(period_map, lead, velocity))
    except NoOrbitError:
        return inf
    # The multiplier may be that of the resonator.
    decay = -log(orbit.fast_multiplier) / period_map.turns
    return max(decay, min_bend_decay(period_map.held.device, fast))


def velocity_of_bend(device: Device, fast: FastVibration, decay: float, angle: float) -> float:
    """What a bend of this decay changes the slow velocity by [m/s].

    After a drive angle [rad] in which it decayed.
    """
    if isinf(decay):
        return 0.0
    # All friction, for as long as the bend takes to decay.
    impulse = tau * friction_share(device, fast) * fast.velocity / decay
    return impulse * exp(-decay * angle / tau)
