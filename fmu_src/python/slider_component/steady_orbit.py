"""Steady motion as a held orbit: the velocity at which a load is the one that holds.

Both results are exact, for a held orbit is a periodic motion of the full device.
"""

from __future__ import annotations

from math import cos, inf, pi

from .held_orbit import HeldOrbit, NoOrbitError, OrbitStatus, held_orbit_at, steady_orbit_at
from .period_map import PeriodMap

SAMPLES = 12
"""Velocities at which orbits tell where steady motion is."""

MAX_HALVINGS = 60
"""Most halvings between two of them."""

SAMPLED_REACH = 1.05
"""Largest sampled velocity, in v_q: beyond grazing unless friction is strong."""


def steady_orbit(period_map: PeriodMap, lead: float, load: float) -> HeldOrbit:
    """The steady motion under `load` [N] to which motion at other velocities tends.

    Orbits at a few velocities tell how many there are. Raises NoOrbitError: RUNS_AWAY for none,
    UNDETERMINED for several, and the reason of the last failure where no orbit was found.
    """
    sliding = period_map.sliding_friction(lead)
    velocity, excess = -inf, load - sliding
    sample: HeldOrbit | None = None
    failure = OrbitStatus.RUNS_AWAY
    brackets: list[tuple[float, float, HeldOrbit | None]] = []
    for i in range(SAMPLES + 1):
        before, at_before = velocity, excess
        if i < SAMPLES:
            sampled = -SAMPLED_REACH * period_map.speed * cos(pi * (i + 0.5) / SAMPLES)
            try:
                sample = held_orbit_at(period_map, lead, sampled, sample)
            except NoOrbitError as error:
                failure, sample = error.status, None
                continue
            velocity, excess = sampled, load + sample.friction
        else:
            velocity, excess = inf, load + sliding
        if at_before < 0.0 <= excess:
            brackets.append((before, velocity, sample))
    if len(brackets) != 1:
        raise NoOrbitError(OrbitStatus.UNDETERMINED if brackets else failure)
    low, high, sample = brackets[0]
    reach = 2.0 * SAMPLED_REACH * period_map.speed
    return _refined(period_map, lead, load, max(low, -reach), min(high, reach), sample)


def blocking_force(period_map: PeriodMap, lead: float) -> float:
    """The load [N] that stops the slider. Raises NoOrbitError."""
    return -held_orbit_at(period_map, lead, 0.0).friction


def _refined(
    period_map: PeriodMap,
    lead: float,
    load: float,
    low: float,
    high: float,
    sample: HeldOrbit | None,
) -> HeldOrbit:
    """The steady motion between two velocities, by the tangent, or else between the halves."""
    for _ in range(MAX_HALVINGS):
        try:
            orbit = steady_orbit_at(period_map, lead, load, sample)
            if low <= orbit.velocity <= high:
                return orbit
        except NoOrbitError:
            pass
        middle = 0.5 * (low + high)
        sample = held_orbit_at(period_map, lead, middle, sample)
        low, high = (low, middle) if sample.friction + load > 0.0 else (middle, high)
    raise NoOrbitError(OrbitStatus.NOT_CONVERGED)
