"""Steady velocity and blocking force for the present inputs: by first-order averages, or exact."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

from .averaged import Averaged, averaged
from .bristle import bristle_of
from .device import Device, Inputs
from .fast_vibration import fast_vibration
from .friction_laws import friction_law_of
from .held_orbit import HeldOrbit, NoOrbitError, check_stable, held_orbit_at, steady_orbit_at
from .orbit_motion import has_slow_motion
from .orbit_ride import orbit_phase_of
from .orbit_tables import orbit_map
from .period_map import PeriodMap
from .refusal import Refusal
from .steady_orbit import blocking_orbit, check_unique, steady_orbit
from .vibrating_load import EXACT, turns_to_repeat

SAME = 0.05
"""Largest difference, in fast velocities, between steady velocities of first and second order that
belong to the same balance."""


@lru_cache(maxsize=8)
def prediction_of(device: Device, inputs: Inputs, normal_lead: float) -> Averaged:
    """The prediction of the averaging order of the device; `normal_lead` [rad] as for `averaged`.

    By second order both are those of periodic motions of the full device. Where the normal load
    never repeats there is no such motion, and the prediction is that of first order. So it is, but
    not `valid`, where the vibration does not decay, where no steady motion or more than one is
    found, or several at one velocity, and at fidelity 0 where the motion itself is averaged to
    first order.
    """
    prediction = averaged(device, inputs, normal_lead)
    slow = orbit_phase_of(device, inputs.frequency_ratio)
    repeats = turns_to_repeat(device, inputs.frequency_ratio, EXACT) is not None
    repeats = repeats or device.normal_amplitude == 0.0
    if device.averaging_order < 2 or not prediction.valid:
        return prediction
    if device.fidelity == 0 and not has_slow_motion(device, inputs, fast_vibration(device)):
        return replace(prediction, valid=False)
    if not repeats:
        return prediction
    if slow.turns is None:
        return replace(prediction, valid=False)
    first, lead = prediction.steady_velocity, inputs.phase + normal_lead
    try:
        period_map = orbit_map(device, slow.waves, slow.turns)
        steady = _steady(period_map, lead, inputs.load, first)
        blocked = blocking_orbit(period_map, lead)
        if not has_slow_motion(device, inputs, period_map.fast):
            check_unique(period_map, steady)
            check_unique(period_map, blocked)
        return Averaged(steady.velocity, -blocked.friction, valid=True)
    except (NoOrbitError, Refusal):
        return replace(prediction, valid=False)


def _steady(period_map: PeriodMap, lead: float, load: float, first: float) -> HeldOrbit:
    """The steady motion, from the velocity of first order or else by a search over velocities.

    Raises NoOrbitError.
    """
    if _is_monotonic(period_map):
        try:
            orbit = held_orbit_at(period_map, lead, first)
            orbit = steady_orbit_at(period_map, lead, load, orbit)
            if abs(orbit.velocity - first) <= SAME * period_map.speed:
                check_stable(period_map, orbit)
                return orbit
        except NoOrbitError:
            pass
    return steady_orbit(period_map, lead, load)


def _is_monotonic(period_map: PeriodMap) -> bool:
    """Whether friction is monotonic in the slow velocity, so that there is one balance."""
    device = period_map.held.device
    bristle = bristle_of(device)
    drag = friction_law_of(device.friction_law).averaged.drag(bristle, period_map.speed)
    return device.normal_amplitude <= device.normal_preload and drag <= bristle.coefficient
