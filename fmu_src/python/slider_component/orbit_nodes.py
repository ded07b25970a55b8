"""The orbits at the nodes of a panel.

Nodes are added until a polynomial through those before has the values at two of them. What is known
of the panel is the first guess of the next orbit.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from math import cos, inf, pi

from .held_orbit import (
    HeldOrbit,
    NoOrbitError,
    OrbitStatus,
    held_orbit_at,
    held_orbit_linearised,
    is_same_orbit,
)
from .motion import State
from .orbit_newton import MAX_MAPS
from .orbit_panel import (
    BASE_PANELS,
    MAX_DEPTH,
    MAX_DEPTH_MISSING,
    OrbitPanel,
    direction_of_panel,
    trimmed,
)
from .orbit_point import Quantities, orbit_way, section_quantities
from .panel_series import NODE, ORBIT_NODES, PASSING_NODES, PanelSeries
from .period_map import PeriodMap

HOLDING = 2
"""Nodes in a row whose values a polynomial must have for it to hold."""

MIN_NODES = 6
"""Minimum number of nodes of a panel."""

GAIN_OF_NODE = 4.0
"""Smallest factor by which a node reduces the miss.

With less, the last node does not hold, and the panel is halved."""

GUESSING = 3
"""Nodes from which on a polynomial is a better guess than the tangent at the next orbit."""

NOISE = 0.1
"""Sum of the last coefficients that are left out, in the accuracy: differences are noisy."""

NO_ADDED_MASS = 1e-6
"""Added mass up to which it is left out under Coulomb friction."""


@dataclass(frozen=True, slots=True)
class CurveRange:
    """The velocities between grazing, and the accuracy of the quantities there."""

    lead: float
    middle: float
    reach: float
    accuracies: Quantities


@dataclass(slots=True)
class NodeValues:
    """The polynomial of a quantity, and its accuracy.

    By how much it missed the value at the last node, and the number of nodes in a row at which it
    `held`.
    """

    accuracy: float
    series: PanelSeries = field(default_factory=PanelSeries)
    missed: float = inf
    held: int = 0

    def add(self, value: float) -> None:
        """Add the value at the next node."""
        self.missed = abs(self.series.add(value))
        self.held = self.held + 1 if self.missed <= self.accuracy else 0

    @property
    def holds(self) -> bool:
        """Whether the polynomial has the values of its last nodes."""
        return self.held >= HOLDING


class PanelOrbits:
    """The orbits at the first nodes of a panel, and what tables have of them.

    `maps` counts those that it takes, Jacobians included.
    """

    def __init__(self, period_map: PeriodMap, curve: CurveRange, depth: int, index: int) -> None:
        self._map, self._curve, self._depth, self._index = period_map, curve, depth, index
        self._side = -1 if (index >> depth) % 2 == 1 else 1
        self._orbits: list[HeldOrbit] = []
        accuracies = curve.accuracies._asdict()
        self._of = {name: NodeValues(accuracy) for name, accuracy in accuracies.items()}
        self.maps = 0

    def panel(self) -> OrbitPanel:
        """The panel, made from as many nodes as it takes."""
        depth, index, holds = self._depth, self._index, False
        try:
            while not holds and not self._is_hopeless():
                self._add_node()
                holds = self._all_hold()
        except NoOrbitError:
            return OrbitPanel(depth, index, depth >= MAX_DEPTH_MISSING, None, self.maps)
        coefficients = tuple(
            trimmed(_without_noise(of.series.chebyshev(self._side), NOISE * of.accuracy))
            for of in self._of.values()
        )
        return OrbitPanel(depth, index, holds or depth >= MAX_DEPTH, coefficients, self.maps)

    def _add_node(self) -> None:
        """Find the orbit at the next node. Raises NoOrbitError.

        The first is the one halfway to grazing, where a search without neighbour is at its best; at
        the other end such a search must find the same orbit. The added mass is found as long as it
        does not hold; under Coulomb friction it is left out where it is negligible at the first
        node.
        """
        curve, node, depth = self._curve, len(self._orbits), self._depth
        width, x = pi / (BASE_PANELS << depth), NODE[len(self._orbits)]
        chi = (self._index + 0.5 + 0.5 * self._side * x) * width
        velocity = curve.middle + curve.reach * cos(chi)
        is_checked = depth == 0 and node == PASSING_NODES - 1
        factor, way = self._of["factor"], self._of["way"]
        lags, moves = not factor.holds, not way.holds
        try:
            orbit = self._orbit_at(x, velocity)
            if lags or is_checked:
                orbit = held_orbit_linearised(self._map, orbit)
            of = section_quantities(self._map, orbit)._asdict()
            if moves:
                of["way"] = orbit_way(self._map, orbit)
        except NoOrbitError:
            self.maps += MAX_MAPS
            raise
        self.maps += orbit.maps + moves
        self._check(orbit, is_checked=is_checked)
        coulomb = self._map.held.device.friction_law == 0
        if coulomb and node == 0 and abs(orbit.factor - 1.0) <= NO_ADDED_MASS:
            factor.add(1.0)
            factor.held = HOLDING
            lags = False
        for name, values in self._of.items():
            if (name != "factor" or lags) and (name != "way" or moves):
                values.add(of[name])
        self._orbits.append(orbit)

    def _orbit_at(self, x: float, velocity: float) -> HeldOrbit:
        """Find the orbit at a place, where the velocity is this [m/s]. Raises NoOrbitError."""
        scales, lead, count = self._map, self._curve.lead, len(self._orbits)
        if count == 0:
            return held_orbit_at(scales, lead, velocity)
        neighbour = self._orbits[min(range(count), key=lambda i: abs(NODE[i] - x))]
        if count >= GUESSING:
            try:
                return held_orbit_at(scales, lead, velocity, self._guess(neighbour, x, velocity))
            except NoOrbitError:
                pass
        return held_orbit_at(scales, lead, velocity, neighbour)

    def _guess(self, neighbour: HeldOrbit, x: float, velocity: float) -> HeldOrbit:
        """An orbit by the polynomials, otherwise like its neighbour."""
        of = Quantities(*(values.series.at(x) for values in self._of.values()))
        scales, section = self._map, neighbour.section.copied()
        share = scales.held.plant.mass_fraction
        driven = scales.fast.pair_velocity * cos(section.theta)
        slider = velocity + of.offset - share * of.rate - driven
        section.state, section.bristle = State(slider, of.displacement, of.rate), of.bristle
        return replace(neighbour, section=section, velocity=velocity, friction=of.friction)

    def _check(self, orbit: HeldOrbit, *, is_checked: bool) -> None:
        """Raise NoOrbitError for another direction, and where there is another orbit."""
        undetermined = NoOrbitError(OrbitStatus.UNDETERMINED)
        if orbit.direction != direction_of_panel(self._depth, self._index):
            raise undetermined
        if not is_checked:
            return
        try:
            other = held_orbit_at(self._map, self._curve.lead, orbit.velocity)
        except NoOrbitError:
            self.maps += MAX_MAPS
            return
        self.maps += other.maps
        if not is_same_orbit(self._map, orbit, other):
            raise undetermined

    def _all_hold(self) -> bool:
        enough = len(self._orbits) >= MIN_NODES
        return enough and all(values.holds for values in self._of.values())

    def _is_hopeless(self) -> bool:
        """Whether further nodes will not do."""
        count = len(self._orbits)
        left = GAIN_OF_NODE ** (ORBIT_NODES - 1 - count)
        misses = any(
            not values.holds and values.missed > left * values.accuracy
            for values in self._of.values()
        )
        return count == ORBIT_NODES or (count >= MIN_NODES and misses)


def _without_noise(coefficients: list[float], noise: float) -> list[float]:
    """Leave out the last coefficients, as many as add up to no more than `noise`."""
    left, count = noise, len(coefficients)
    while count > 1 and abs(coefficients[count - 1]) <= left:
        count -= 1
        left -= abs(coefficients[count])
    return coefficients[:count]
