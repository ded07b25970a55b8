"""An orbit as tables have it."""

from __future__ import annotations

from math import sin
from typing import NamedTuple

from .held_orbit import HeldOrbit, NoOrbitError, OrbitStatus
from .moment import Moment
from .orbit_drift import held_orbit_offset
from .period_map import PeriodMap

WAY_PARTS = 8
"""Parts of a turn over which the mean of the way is taken."""


class Quantities(NamedTuple):
    """What is tabulated of an orbit.

    Mean friction F2 [N], 1 + kappa_m; at the section w1 [m/s], its integral over time [m] of zero
    mean, and resonator [m, m/s] and bristle.
    """

    friction: float
    factor: float
    offset: float
    way: float
    displacement: float
    rate: float
    bristle: float


class OrbitPoint(NamedTuple):
    """An orbit as tables have it, its section being that in `direction`.

    `found` is false where averages of first order stand for it, `beyond` true where the slider
    never turns back.
    """

    of: Quantities
    direction: int
    found: bool = True
    beyond: bool = False


def section_quantities(period_map: PeriodMap, orbit: HeldOrbit) -> Quantities:
    """What tables have of an orbit, but for its way."""
    section = orbit.section
    return Quantities(
        friction=orbit.friction,
        factor=orbit.factor,
        offset=held_orbit_offset(period_map, orbit, section),
        way=0.0,
        displacement=section.state.displacement,
        rate=section.state.rate,
        bristle=section.bristle,
    )


def point_of(period_map: PeriodMap, orbit: HeldOrbit) -> OrbitPoint:
    """An orbit as tables have it. Raises NoOrbitError where a map fails."""
    of = section_quantities(period_map, orbit)._replace(way=orbit_way(period_map, orbit))
    beyond = orbit.reversals == 0 and not orbit.sticks
    return OrbitPoint(of, orbit.direction, beyond=beyond)


def orbit_way(period_map: PeriodMap, orbit: HeldOrbit) -> float:
    """What w1 adds to the way at the section [m], its mean over a period being 0.

    Raises NoOrbitError where a map fails.
    """
    parts = WAY_PARTS * period_map.turns
    part, first, total = period_map.period / parts, _centre(period_map, orbit.section), 0.0
    now = orbit.section
    for i in range(1, parts):
        now = advanced(period_map, orbit, now, part)
        total += _centre(period_map, now) - first - orbit.velocity * i * part
    return -total / parts


def _centre(period_map: PeriodMap, moment: Moment) -> float:
    """Place [m] of the pair's centre, without what the drive moves it."""
    plant = period_map.held.plant
    driven = period_map.fast.pair_velocity / plant.drive_frequency * sin(moment.theta)
    return moment.position + plant.mass_fraction * moment.state.displacement + driven


def advanced(period_map: PeriodMap, orbit: HeldOrbit, moment: Moment, duration: float) -> Moment:
    """The moment `duration` [s] later. Raises NoOrbitError where the map fails."""
    if not duration > 0.0:
        return moment
    after = period_map.advance(orbit.lead, -orbit.friction, moment, duration)
    if after is None:
        raise NoOrbitError(OrbitStatus.NOT_CONVERGED)
    return after
