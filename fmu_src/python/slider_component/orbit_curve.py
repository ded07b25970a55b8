"""Held orbits over the slow velocity, under one lead of the normal load: tabulated, lazily.

Between the grazing velocities, beyond which the slider never turns back, all is smooth in the angle
chi of V = middle + reach cos(chi): Chebyshev polynomials on panels in chi, halved until they hold.
Beyond, friction and its answer stay as they are. A panel is made when it is first asked for, always
from the same start: what it says does not depend on what was asked before.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import acos, cos, inf, isfinite, pi, sin, tau
from typing import NamedTuple

from .contact import BACKWARD, FORWARD
from .held_orbit import (
    HeldOrbit,
    NoOrbitError,
    OrbitStatus,
    held_orbit_at,
    held_orbit_linearised,
    is_same_orbit,
)
from .moment import Moment
from .motion import State
from .orbit_drift import held_orbit_offset
from .orbit_newton import MAX_MAPS
from .orbit_shifts import ShiftPoint, shift_point
from .period_map import PeriodMap
from .trace import Trace

ORBIT_NODES = 12
"""Nodes of a panel."""

BASE_PANELS = 4
"""Panels in chi that are halved."""

MAX_DEPTH = 6
"""Most halvings."""

MAX_DEPTH_MISSING = 2
"""Most halvings of a panel in which an orbit is missing."""

ROUNDING = 1e-13
"""Sum of the last coefficients up to which they are rounding, over the largest."""

NO_ADDED_MASS = 1e-6
"""Added mass up to which it is left out under Coulomb friction."""

BEYOND = 4.0
"""Velocity beyond grazing at which the orbit there is found, in fast velocities."""

WAY_PARTS = 8
"""Parts of a turn over which the mean of the way is taken."""

PEAK_PARTS = 16
"""Parts of a turn in which the peak of a vibration is looked for."""

PEAK_REFINEMENTS = 3
"""Parabolas that refine it."""

MAX_PEAK_WAVES = 8.0
"""Waves of the normal load in a turn up to which the samples follow them."""


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


@dataclass(frozen=True, slots=True)
class OrbitPanel:
    """Chebyshev coefficients over the panel `index` of 2^depth in which each base panel is halved.

    Of each quantity only those that are not rounding, an even number. `coefficients` is None where
    an orbit is missing; `holds` is false where the panel has to be halved. `maps` is how often a
    period was mapped for it.
    """

    depth: int
    index: int
    holds: bool
    coefficients: tuple[tuple[float, ...], ...] | None
    maps: int

    @property
    def direction(self) -> int:
        """Direction of the section."""
        return direction_of_panel(self.depth, self.index)

    def at(self, quantity: int, place: float) -> float:
        """The quantity at `place` = chi / pi BASE_PANELS; only for a panel with coefficients.

        By Clenshaw's recurrences for the even and the odd polynomials, T_2j(x) = T_j(y) and
        T_2j+1(x) = x (U_j(y) - U_j-1(y)) with y = T_2(x).
        """
        assert self.coefficients is not None
        c = self.coefficients[quantity]
        x = 2.0 * (place * (1 << self.depth) - self.index) - 1.0
        y = 2.0 * x * x - 1.0
        even = even_behind = odd = odd_behind = 0.0
        for k in range(len(c) - 2, 0, -2):
            even, even_behind = 2.0 * y * even + (c[k] - even_behind), even
            odd, odd_behind = 2.0 * y * odd + (c[k + 1] - odd_behind), odd
        last_odd = 2.0 * y * odd + (c[1] - odd_behind)
        return y * even + (c[0] - even_behind) + x * (last_odd - odd)

    def point(self, place: float) -> OrbitPoint:
        """All quantities there."""
        of = Quantities(*(self.at(q, place) for q in range(len(Quantities._fields))))
        return OrbitPoint(of, self.direction)


def direction_of_panel(depth: int, index: int) -> int:
    """Direction of the section of orbits on a panel."""
    return FORWARD if index >> depth < BASE_PANELS // 2 else BACKWARD


def place_between(middle: float, reach: float, velocity: float) -> float:
    """Place of a velocity among the base panels, from 0 on; negative beyond grazing."""
    share = (velocity - middle) / reach
    return acos(share) / pi * BASE_PANELS if abs(share) < 1.0 else -1.0


def index_at(place: float, depth: int) -> int:
    """Index of the panel of a depth at a place."""
    return min(int(place * (1 << depth)), (BASE_PANELS << depth) - 1)


def trimmed(coefficients: list[float]) -> tuple[float, ...]:
    """The first coefficients, an even number, without those that are rounding."""
    largest, rest, terms = max(map(abs, coefficients)), 0.0, len(coefficients)
    while terms > 1 and rest <= ROUNDING * largest:
        terms -= 1
        rest += abs(coefficients[terms])
    terms += rest > ROUNDING * largest
    return tuple(coefficients[: terms + terms % 2])


def point_of(period_map: PeriodMap, orbit: HeldOrbit) -> OrbitPoint:
    """An orbit as tables have it. Raises NoOrbitError where a map fails."""
    section = orbit.section
    of = Quantities(
        orbit.friction,
        orbit.factor,
        held_orbit_offset(period_map, orbit, section),
        -_mean_way(period_map, orbit),
        section.state.displacement,
        section.state.rate,
        section.bristle,
    )
    beyond = orbit.reversals == 0 and not orbit.sticks
    return OrbitPoint(of, orbit.direction, beyond=beyond)


class OrbitCurve:
    """The orbits of a period map at one lead. Raises NoOrbitError where there are none.

    A panel holds when its last coefficients are at most `accuracy`, in the scale of their quantity.
    """

    def __init__(self, period_map: PeriodMap, lead: float, accuracy: float) -> None:
        self._map, self.lead, self._accuracy = period_map, lead, accuracy
        high, forward = self._beyond(FORWARD)
        low, backward = self._beyond(BACKWARD)
        if not low < high:
            raise NoOrbitError(OrbitStatus.NOT_CONVERGED)
        self.middle, self.reach = 0.5 * (low + high), 0.5 * (high - low)
        self.beyond = backward, forward
        self._panels: dict[tuple[int, int], OrbitPanel] = {}
        self._shifts: dict[int, ShiftPoint | None] = {}

    def shift(self, index: int) -> ShiftPoint | None:
        """A point of shifts, measured where it is missing; None where that fails."""
        if index not in self._shifts:
            self._shifts[index] = shift_point(self._map, self.lead, self.middle, self.reach, index)
        return self._shifts[index]

    def panel(self, depth: int, index: int) -> OrbitPanel:
        """A panel, made where it is missing."""
        key = depth, index
        if key not in self._panels:
            self._panels[key] = self._made(depth, index)
        return self._panels[key]

    def _beyond(self, direction: int) -> tuple[float, OrbitPoint]:
        """The grazing velocity [m/s] in a direction, and the orbit beyond it."""
        velocity = BEYOND * direction * self._map.speed
        orbit = held_orbit_at(self._map, self.lead, velocity)
        grazing = direction * _grazing_peak(self._map, orbit)
        if not isfinite(grazing):
            raise NoOrbitError(OrbitStatus.NOT_CONVERGED)
        return grazing, point_of(self._map, orbit)

    def _made(self, depth: int, index: int) -> OrbitPanel:
        points, maps = self._nodes(depth, index)
        if points is None:
            return OrbitPanel(depth, index, depth >= MAX_DEPTH_MISSING, None, maps)
        holds, coefficients = True, []
        for values, scale in zip(zip(*points, strict=True), self._scales(), strict=True):
            c = [_coefficient(values, k) for k in range(ORBIT_NODES)]
            if max(abs(c[-1]), abs(c[-2])) > self._accuracy * scale and depth < MAX_DEPTH:
                holds = False
            coefficients.append(trimmed(c))
        return OrbitPanel(depth, index, holds, tuple(coefficients), maps)

    def _nodes(self, depth: int, index: int) -> tuple[list[Quantities] | None, int]:
        """The orbits at the nodes, each from the one before.

        The first is the one halfway to grazing, where a search without neighbour is at its best.
        Under Coulomb friction the added mass is left out where it is negligible there. At the last
        a search without neighbour must find the same orbit. Tells the maps that took, too; None
        where an orbit is missing.
        """
        width = pi / (BASE_PANELS << depth)
        nodes = list(range(ORBIT_NODES))
        if (index >> depth) % 2 == 1:
            nodes.reverse()
        coulomb, lags = self._map.held.device.friction_law == 0, True
        found: dict[int, Quantities] = {}
        orbit: HeldOrbit | None = None
        maps = 0
        try:
            for node in nodes:
                chi = (index + 0.5 + 0.5 * cos(pi * (node + 0.5) / ORBIT_NODES)) * width
                velocity = self.middle + self.reach * cos(chi)
                orbit = held_orbit_at(self._map, self.lead, velocity, orbit)
                is_checked = depth == 0 and len(found) == ORBIT_NODES - 1
                if lags or is_checked:
                    orbit = held_orbit_linearised(self._map, orbit)
                    lags = (lags and abs(orbit.factor - 1.0) > NO_ADDED_MASS) or not coulomb
                    orbit = orbit if lags else replace(orbit, factor=1.0)
                maps += orbit.maps + 1
                if orbit.direction != direction_of_panel(depth, index):
                    return None, maps
                if is_checked:
                    others, same = self._is_the_only_one(orbit)
                    maps += others
                    if not same:
                        return None, maps
                found[node] = point_of(self._map, orbit).of
        except NoOrbitError:
            return None, maps + MAX_MAPS
        return [found[node] for node in range(ORBIT_NODES)], maps

    def _is_the_only_one(self, orbit: HeldOrbit) -> tuple[int, bool]:
        """Whether a search without neighbour finds the same orbit, and the maps that takes."""
        try:
            other = held_orbit_at(self._map, self.lead, orbit.velocity)
        except NoOrbitError:
            return MAX_MAPS, True
        return other.maps, is_same_orbit(self._map, orbit, other)

    def _scales(self) -> Quantities:
        """Scales in which the quantities have to hold."""
        scales, w = self._map, self._map.held.plant.drive_frequency
        backward, forward = self.beyond
        return Quantities(
            friction=abs(forward.of.friction) + abs(backward.of.friction),
            factor=10.0,
            offset=scales.speed,
            way=scales.speed / w,
            displacement=10.0 * scales.swing,
            rate=10.0 * scales.swing * w,
            bristle=100.0 * scales.held.bristle.coefficient,
        )


def _coefficient(values: tuple[float, ...], k: int) -> float:
    total = sum(value * cos(pi * k * (j + 0.5) / ORBIT_NODES) for j, value in enumerate(values))
    return total * (2.0 if k > 0 else 1.0) / ORBIT_NODES


def _centre(period_map: PeriodMap, state: State, position: float, theta: float) -> float:
    """Place [m] of the pair's centre at a position, without what the drive moves it."""
    plant = period_map.held.plant
    driven = period_map.fast.pair_velocity / plant.drive_frequency * sin(theta)
    return position + plant.mass_fraction * state.displacement + driven


def _advanced(
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


def _mean_way(period_map: PeriodMap, orbit: HeldOrbit) -> float:
    """The mean over a period of what w1 adds to the way since the section [m]."""
    parts, section = WAY_PARTS * period_map.turns, orbit.section
    part, w, total = period_map.period / parts, period_map.held.plant.drive_frequency, 0.0
    first = _centre(period_map, section.state, section.position, section.theta)

    def add(index: int, state: State, position: float) -> None:
        nonlocal total
        since = (index + 1) * part
        centre = _centre(period_map, state, position, section.theta + w * since)
        total += centre - first - orbit.velocity * since

    _advanced(period_map, orbit, section, (parts - 1) * part, Trace(part, part, parts - 1, add))
    return total / parts


def _grazing_peak(period_map: PeriodMap, orbit: HeldOrbit) -> float:
    """Peak [m/s] of the vibration against the direction of sliding, which it takes off from V.

    It is the largest of samples, refined by parabolas through three points around it.
    """
    w = period_map.held.plant.drive_frequency
    waves = min(abs(period_map.held.inputs.frequency_ratio), MAX_PEAK_WAVES)
    parts = PEAK_PARTS * period_map.turns * (1 + int(waves))
    part, time = tau * period_map.turns / parts, period_map.period / parts
    best, largest = -inf, 0

    def against(state: State) -> float:
        return orbit.direction * (orbit.velocity - state.velocity)

    def keep_largest(index: int, state: State, _position: float) -> None:
        nonlocal best, largest
        if against(state) > best:
            best, largest = against(state), index

    trace = Trace(time, time, parts, keep_largest)
    _advanced(period_map, orbit, orbit.section, period_map.period, trace)
    base = _advanced(period_map, orbit, orbit.section, part * largest / w)

    def at(angle: float) -> float:
        return against(_advanced(period_map, orbit, base, angle / w).state)

    place = part
    for _ in range(PEAK_REFINEMENTS):
        behind, ahead = at(place - part), at(place + part)
        bend = behind - 2.0 * best + ahead
        shift = 0.5 * part * (behind - ahead) / bend if bend < 0.0 else 0.0
        moved = max(place + min(max(shift, -0.5 * part), 0.5 * part), 0.0)
        there = at(moved)
        if there > best:
            best, place = there, moved
        part *= 0.1
    return best
