"""Held orbits over the slow velocity, under one lead of the normal load: tabulated, lazily.

Between the grazing velocities, beyond which the slider never turns back, all is smooth in the angle
chi of V = middle + reach cos(chi): polynomials on panels in chi, with more nodes until they hold,
or halved. Beyond, friction and its answer stay as they are. A panel is made when it is first asked
for, always from the same start: what it says does not depend on what was asked before.
"""

from __future__ import annotations

from math import inf, isfinite, tau

from .contact import BACKWARD, FORWARD
from .held_orbit import HeldOrbit, NoOrbitError, OrbitStatus, held_orbit_at
from .motion import State
from .orbit_nodes import CurveRange, PanelOrbits
from .orbit_panel import OrbitPanel
from .orbit_point import OrbitPoint, Quantities, advanced, point_of
from .orbit_shifts import ShiftPoint, shift_point
from .period_map import PeriodMap
from .trace import Trace

BEYOND = 4.0
"""Velocity beyond grazing at which the orbit there is found, in fast velocities."""

PEAK_PARTS = 16
"""Parts of a turn in which the peak of a vibration is looked for."""

PEAK_REFINEMENTS = 3
"""Parabolas that refine it."""

MAX_PEAK_WAVES = 8.0
"""Waves of the normal load in a turn up to which the samples follow them."""


class OrbitCurve:
    """The orbits of a period map at one lead. Raises NoOrbitError where there are none.

    A panel holds to an `accuracy` in the scales of its quantities.
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
            accuracies = Quantities(*(self._accuracy * scale for scale in self._scales()))
            curve = CurveRange(self.lead, self.middle, self.reach, accuracies)
            self._panels[key] = PanelOrbits(self._map, curve, depth, index).panel()
        return self._panels[key]

    def _beyond(self, direction: int) -> tuple[float, OrbitPoint]:
        """The grazing velocity [m/s] in a direction, and the orbit beyond it."""
        velocity = BEYOND * direction * self._map.speed
        orbit = held_orbit_at(self._map, self.lead, velocity)
        grazing = direction * _grazing_peak(self._map, orbit)
        if not isfinite(grazing):
            raise NoOrbitError(OrbitStatus.NOT_CONVERGED)
        return grazing, point_of(self._map, orbit)

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
    advanced(period_map, orbit, orbit.section, period_map.period, trace)
    base = advanced(period_map, orbit, orbit.section, part * largest / w)

    def at(angle: float) -> float:
        return against(advanced(period_map, orbit, base, angle / w).state)

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
