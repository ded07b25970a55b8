"""An orbit as tables have it."""

from __future__ import annotations

from math import sin
from typing import NamedTuple

from .held_orbit import HeldOrbit, NoOrbitError, OrbitStatus
from .moment import Moment
from .motion import State
from .orbit_drift import held_orbit_offset
from .period_map import PeriodMap
from .trace import Trace

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
    parts, section = WAY_PARTS * period_map.turns, orbit.section
    part, w, total = period_map.period / parts, period_map.held.plant.drive_frequency, 0.0
    first = _centre(period_map, section.state, section.position, section.theta)

    def add(index: int, state: State, position: float) -> None:
        nonlocal total
        since = (index + 1) * part
        centre = _centre(period_map, state, position, section.theta + w * since)
        total += centre - first - orbit.velocity * since

    advanced(period_map, orbit, section, (parts - 1) * part, Trace(part, part, parts - 1, add))
    return -total / parts


def _centre(period_map: PeriodMap, state: State, position: float, theta: float) -> float:
    """Place [m] of the pair's centre at a position, without what the drive moves it."""
    plant = period_map.held.plant
    driven = period_map.fast.pair_velocity / plant.drive_frequency * sin(theta)
    return position + plant.mass_fraction * state.displacement + driven


def advanced(
    period_map: PeriodMap,
    orbit: HeldOrbit,
    moment: Moment,
    duration: float,
    trace: Trace | None = None,
) -> Moment:
    """The moment `duration` [s] later. Raises NoOrbitError where the map fails."""
    if not duration > 0.0:
        return moment
    after = period_map.advance(orbit.lead, -orbit.friction, moment, duration, trace)
    if after is None:
        raise NoOrbitError(OrbitStatus.NOT_CONVERGED)
    return after
