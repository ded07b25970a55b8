"""Orbits by Newton's method, each from the one found last, or else from none."""

from __future__ import annotations

from .held_orbit import HeldOrbit, NoOrbitError, held_orbit_at, held_orbit_linearised
from .orbit_newton import MAX_MAPS
from .orbit_point import OrbitPoint, point_of
from .period_map import PeriodMap
from .shift_tables import ShiftCurve


class OrbitSearch:
    """Searches along a motion; `maps` counts the period maps that they take."""

    curve: ShiftCurve | None = None

    def __init__(self, period_map: PeriodMap) -> None:
        self._map = period_map
        self._last: HeldOrbit | None = None
        self.maps = 0

    def friction(self, lead: float, velocity: float) -> tuple[float, float] | None:
        """See OrbitTable."""
        orbit = self._found(lead, velocity)
        return None if orbit is None else (orbit.friction, orbit.factor)

    def point(self, lead: float, velocity: float) -> OrbitPoint | None:
        """See OrbitTable."""
        orbit = self._found(lead, velocity)
        if orbit is None:
            return None
        try:
            return point_of(self._map, orbit)
        except NoOrbitError:
            return None

    def _found(self, lead: float, velocity: float) -> HeldOrbit | None:
        starts = [self._last, None] if self._last is not None else [None]
        self._last = None
        for start in starts:
            try:
                orbit = held_orbit_at(self._map, lead, velocity, start)
            except NoOrbitError:
                self.maps += MAX_MAPS
                continue
            self._last = self._lagging(orbit)
            break
        return self._last

    def _lagging(self, orbit: HeldOrbit) -> HeldOrbit | None:
        """The orbit with its added mass under LuGre friction."""
        if self._map.held.device.friction_law == 0:
            self.maps += orbit.maps
            return orbit
        self.maps += orbit.maps + self._map.states + 2
        try:
            return held_orbit_linearised(self._map, orbit)
        except NoOrbitError:
            return None
