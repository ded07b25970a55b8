"""The tables of held orbits: a cache of pure functions of device and lead."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache
from math import cos, tau
from typing import Protocol

from .device import Device
from .held_orbit import NoOrbitError
from .orbit_curve import OrbitCurve
from .orbit_panel import MAX_DEPTH, OrbitPanel, index_at, place_between, trimmed
from .orbit_point import OrbitPoint, Quantities
from .orbit_search import OrbitSearch
from .orbit_shifts import NO_SHIFT, ShiftPoint
from .period_map import PeriodMap, period_map
from .shift_tables import ShiftCurve
from .slow_motion_error import table_accuracy

SERIES_LEADS = 9
"""Leads between which orbits are interpolated by a Fourier series."""

SERIES_DEPTH = 2
"""Most halvings of panels between which orbits are interpolated over leads: each is one for all
leads, and orbits that need smaller ones are searched."""

CURVES = 14
"""Curves that are kept: those, a combination of them, and the curves of MAX_LEADS leads."""


class OrbitTable(Protocol):
    """Orbits over lead and slow velocity; those at one lead are a `curve`."""

    curve: ShiftCurve | None

    @property
    def maps(self) -> int:
        """Period maps of all that was asked for, whether it was tabulated before or not."""
        ...

    def friction(self, lead: float, velocity: float) -> tuple[float, float] | None:
        """Mean friction F2 [N] and 1 + kappa_m; None where there is no orbit."""
        ...

    def point(self, lead: float, velocity: float) -> OrbitPoint | None:
        """All quantities; None where there is no orbit."""
        ...


def orbit_map(device: Device, waves: float, turns: int) -> PeriodMap:
    """The period map of the full device. Raises Refusal as `period_map` does."""
    return _map(_what_orbits_depend_on(device), waves, turns)


def curve_table(device: Device, waves: float, turns: int, lead: float) -> OrbitTable:
    """The table at one lead, whatever lead is asked for."""
    curve = _curve(_what_orbits_depend_on(device), waves, turns, lead)
    return _NoTable() if curve is None else _CurveTable(curve, MAX_DEPTH, None)


def combined_table(device: Device, waves: float, turns: int, lead: float) -> OrbitTable:
    """The same from the curves at SERIES_LEADS leads, for a contact that does not lift."""
    combined = _combined(_what_orbits_depend_on(device), waves, turns, lead)
    search = OrbitSearch(orbit_map(device, waves, turns))
    return _NoTable() if combined is None else _CurveTable(combined, SERIES_DEPTH, search)


def series_table(device: Device, waves: float, turns: int) -> OrbitTable:
    """The table over all leads, for a contact that does not lift."""
    series = _series(_what_orbits_depend_on(device), waves, turns)
    search = OrbitSearch(orbit_map(device, waves, turns))
    return _NoTable() if series is None else _SeriesTable(series, search)


class _Curve(Protocol):
    """What OrbitCurve and a combination of them have in common (see `shift_tables.ShiftCurve`)."""

    middle: float
    reach: float
    beyond: tuple[OrbitPoint, OrbitPoint]

    def panel(self, depth: int, index: int) -> OrbitPanel:
        """A panel, made where it is missing."""
        ...

    def shift(self, index: int) -> ShiftPoint | None:
        """A point of shifts, measured where it is missing; None where that fails."""
        ...


class _NoTable:
    """A table without orbits."""

    curve: ShiftCurve | None = None
    maps = 0

    def friction(self, lead: float, velocity: float) -> tuple[float, float] | None:
        """See OrbitTable."""
        return None

    def point(self, lead: float, velocity: float) -> OrbitPoint | None:
        """See OrbitTable."""
        return None


class _Asked:
    """The panels that were asked for, and the period maps that they take."""

    def __init__(self) -> None:
        self._panels: set[tuple[int, int]] = set()
        self.maps = 0

    def for_panel(self, depth: int, index: int, maps: int) -> None:
        """Take note of a panel."""
        if (depth, index) not in self._panels:
            self._panels.add((depth, index))
            self.maps += maps


class _CurveTable:
    """The table of a curve, whose panels are halved up to a depth `deepest`.

    Where they would have to be halved further, `search` finds the orbits.
    """

    def __init__(self, curve: _Curve, deepest: int, search: OrbitSearch | None) -> None:
        self.curve: ShiftCurve | None = curve
        self._curve, self._deepest, self._search = curve, deepest, search
        self._asked = _Asked()

    @property
    def maps(self) -> int:
        """See OrbitTable."""
        return self._asked.maps + (self._search.maps if self._search else 0)

    def friction(self, lead: float, velocity: float) -> tuple[float, float] | None:
        """See OrbitTable."""
        curve = self._curve
        place = place_between(curve.middle, curve.reach, velocity)
        if place < 0.0:
            of = curve.beyond[velocity > curve.middle].of
            return of.friction, of.factor
        panel = self._panel_around(place)
        if panel is None:
            return self._search.friction(lead, velocity) if self._search else None
        return panel.at(0, place), panel.at(1, place)

    def point(self, lead: float, velocity: float) -> OrbitPoint | None:
        """See OrbitTable."""
        curve = self._curve
        place = place_between(curve.middle, curve.reach, velocity)
        if place < 0.0:
            return curve.beyond[velocity > curve.middle]
        panel = self._panel_around(place)
        if panel is None:
            return self._search.point(lead, velocity) if self._search else None
        return panel.point(place)

    def _panel_around(self, place: float) -> OrbitPanel | None:
        """The panel around a place that holds and has all orbits."""
        for depth in range(self._deepest + 1):
            panel = self._curve.panel(depth, index_at(place, depth))
            self._asked.for_panel(depth, panel.index, panel.maps)
            if panel.holds:
                return panel if panel.coefficients is not None else None
        return None


class _SeriesTable:
    """The table of curves at the leads of the series.

    Where their panels are not wide, `search` finds the orbits.
    """

    curve: ShiftCurve | None = None

    def __init__(self, curves: tuple[OrbitCurve, ...], search: OrbitSearch) -> None:
        self._curves, self._search = curves, search
        self._asked = _Asked()

    @property
    def maps(self) -> int:
        """See OrbitTable."""
        return self._asked.maps + self._search.maps

    def friction(self, lead: float, velocity: float) -> tuple[float, float] | None:
        """See OrbitTable."""
        found = self._sum(lead, velocity, 2)
        if found is None:
            return self._search.friction(lead, velocity)
        return found[0][0], found[0][1]

    def point(self, lead: float, velocity: float) -> OrbitPoint | None:
        """See OrbitTable."""
        found = self._sum(lead, velocity, len(Quantities._fields))
        if found is None:
            return self._search.point(lead, velocity)
        return OrbitPoint(Quantities(*found[0]), *found[1:])

    def _sum(
        self, lead: float, velocity: float, count: int
    ) -> tuple[list[float], int, bool, bool] | None:
        """The first quantities; direction, found and beyond as of OrbitPoint."""
        weights = series_weights(lead)
        pairs = list(zip(weights, self._curves, strict=True))
        middle = sum(weight * curve.middle for weight, curve in pairs)
        reach = sum(weight * curve.reach for weight, curve in pairs)
        place = place_between(middle, reach, velocity)
        if place < 0.0:
            points = [curve.beyond[velocity > middle] for curve in self._curves]
            values = [
                sum(weight * point.of[q] for weight, point in zip(weights, points, strict=True))
                for q in range(count)
            ]
            return values, points[0].direction, True, points[0].beyond
        panels = self._panels(place)
        if panels is None:
            return None
        values = [
            sum(weight * panel.at(q, place) for weight, panel in zip(weights, panels, strict=True))
            for q in range(count)
        ]
        return values, panels[0].direction, True, False

    def _panels(self, place: float) -> list[OrbitPanel] | None:
        """The panels of all curves around a place, of the depth at which all hold."""
        for depth in range(SERIES_DEPTH + 1):
            index = index_at(place, depth)
            panels = [curve.panel(depth, index) for curve in self._curves]
            self._asked.for_panel(depth, index, sum(panel.maps for panel in panels))
            if all(panel.holds for panel in panels):
                return None if any(panel.coefficients is None for panel in panels) else panels
        return None


class _Combination:
    """The curve at a lead that the curves of the series combine to."""

    def __init__(self, curves: tuple[OrbitCurve, ...], lead: float) -> None:
        self._curves, self._weights = curves, series_weights(lead)
        pairs = list(zip(self._weights, curves, strict=True))
        self.middle = sum(weight * curve.middle for weight, curve in pairs)
        self.reach = sum(weight * curve.reach for weight, curve in pairs)
        self.beyond = self._beyond(0), self._beyond(1)
        self._panels: dict[tuple[int, int], OrbitPanel] = {}
        self._shifts: dict[int, ShiftPoint | None] = {}

    def panel(self, depth: int, index: int) -> OrbitPanel:
        """See _Curve."""
        key = depth, index
        if key not in self._panels:
            self._panels[key] = self._made(depth, index)
        return self._panels[key]

    def shift(self, index: int) -> ShiftPoint | None:
        """See _Curve."""
        if index not in self._shifts:
            total: ShiftPoint | None = NO_SHIFT
            for weight, curve in zip(self._weights, self._curves, strict=True):
                point = curve.shift(index)
                total = None if total is None or point is None else total.plus(weight, point)
            self._shifts[index] = total
        return self._shifts[index]

    def _beyond(self, side: int) -> OrbitPoint:
        points = [curve.beyond[side] for curve in self._curves]
        values = [
            sum(weight * value for weight, value in zip(self._weights, column, strict=True))
            for column in zip(*(point.of for point in points), strict=True)
        ]
        return OrbitPoint(Quantities(*values), points[0].direction, beyond=points[0].beyond)

    def _made(self, depth: int, index: int) -> OrbitPanel:
        panels = [curve.panel(depth, index) for curve in self._curves]
        holds = all(panel.holds for panel in panels)
        maps = sum(panel.maps for panel in panels)
        known = [panel.coefficients for panel in panels if panel.coefficients is not None]
        if len(known) < len(panels):
            return OrbitPanel(depth, index, holds, None, maps)
        coefficients = []
        for columns in zip(*known, strict=True):
            length = max(map(len, columns))
            total = [0.0] * length
            for weight, column in zip(self._weights, columns, strict=True):
                for k, value in enumerate(column):
                    total[k] += weight * value
            coefficients.append(trimmed(total))
        return OrbitPanel(depth, index, holds, tuple(coefficients), maps)


def series_weights(lead: float) -> list[float]:
    """Weights of the leads of the series at one lead [rad]: trigonometric cardinal functions.

    Cosines by Chebyshev's recurrence.
    """
    weights = []
    for i in range(SERIES_LEADS):
        cosine = cos(lead - tau * i / SERIES_LEADS)
        before, now, total = 1.0, cosine, 0.5
        for _ in range(SERIES_LEADS // 2):
            total += now
            before, now = now, 2.0 * cosine * now - before
        weights.append(2.0 * total / SERIES_LEADS)
    return weights


def _what_orbits_depend_on(device: Device) -> Device:
    """The device with the start values of what does not change its orbits."""
    start = Device()
    return replace(
        device,
        fidelity=start.fidelity,
        averaging_order=start.averaging_order,
        initial_position=start.initial_position,
        initial_velocity=start.initial_velocity,
        initial_resonator_displacement=start.initial_resonator_displacement,
        initial_resonator_velocity=start.initial_resonator_velocity,
        initial_bristle_deflection=start.initial_bristle_deflection,
    )


_map = lru_cache(maxsize=CURVES)(period_map)


@lru_cache(maxsize=CURVES)
def _curve(device: Device, waves: float, turns: int, lead: float) -> OrbitCurve | None:
    try:
        return OrbitCurve(_map(device, waves, turns), lead, table_accuracy(device))
    except NoOrbitError:
        return None


@lru_cache(maxsize=2)
def _series(device: Device, waves: float, turns: int) -> tuple[OrbitCurve, ...] | None:
    curves = []
    for i in range(SERIES_LEADS):
        curve = _curve(device, waves, turns, tau * i / SERIES_LEADS)
        if curve is None:
            return None
        curves.append(curve)
    return tuple(curves)


@lru_cache(maxsize=CURVES)
def _combined(device: Device, waves: float, turns: int, lead: float) -> _Combination | None:
    series = _series(device, waves, turns)
    return None if series is None else _Combination(series, lead)
