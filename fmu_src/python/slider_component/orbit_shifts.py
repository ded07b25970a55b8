"""By how much time slow motion on held orbits is ahead of true motion.

That is its error over its acceleration: the excess force E decays as V does, so what the mean
velocity errs by is the acceleration g = -f E / Mt times a time, and under held inputs that time
changes with V alone. It is measured at points of a curve in chi and interpolated: a tenth is exact
enough for an error.
"""

from __future__ import annotations

from math import cos, hypot, isfinite, pi, sin
from typing import NamedTuple

from .held_orbit import HeldOrbit, NoOrbitError, held_orbit_at, held_orbit_linearised
from .linear_system import Vector
from .orbit_defect import (
    LAG_PHASES,
    OrbitBend,
    OrbitPassage,
    OrbitProbe,
    orbit_defect,
    orbit_passage,
    orbit_probe,
    velocity_by_excess,
)
from .orbit_linearisation import OrbitLinearisation, linearised
from .period_map import PeriodMap

SHIFT_POINTS = 16
"""Points of a curve, in the middle of as many equal parts in chi."""

TOO_STEEP = 2.0
"""Decay of the slow motion in a period from which on the expansion in the excess is cut off, as
next to grazing, where it has no sense."""

UNSURE = 0.1
"""Share of a time that measuring and interpolating it leave unsure. Terms of third order are those
of second by the decay of the slow motion in a period."""

STEP = 1e-3
"""Change of velocity, in the scale of velocities, for derivatives."""


class ShiftPoint(NamedTuple):
    """Times [s] of an orbit.

    What is `gained` per chi by the slow equation, and from point to point by what mean velocity has
    more than V, `shown`; the most by which single turns of the drive differ in an orbit of several;
    by which mean velocity is ahead of that of the motion with the same W, at LAG_PHASES. And the
    added mass kappa_m, how far the resonator lags, over the acceleration [s^2], and the share by
    which terms of higher order change these times.
    """

    gained: float
    shown: float
    of_turn: float
    added_mass: float
    swing: float
    unsure: float
    lags: Vector

    def plus(self, weight: float, other: ShiftPoint) -> ShiftPoint:
        """The same with another one of a `weight`."""
        return ShiftPoint(
            self.gained + weight * other.gained,
            self.shown + weight * other.shown,
            self.of_turn + weight * other.of_turn,
            self.added_mass + weight * other.added_mass,
            self.swing + weight * other.swing,
            self.unsure + weight * other.unsure,
            [a + weight * b for a, b in zip(self.lags, other.lags, strict=True)],
        )


NO_SHIFT = ShiftPoint(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, [0.0] * LAG_PHASES)


class _Neighbours(NamedTuple):
    """An orbit, and another with more velocity by a `step`, from which derivatives by v come."""

    orbit: HeldOrbit
    here: OrbitProbe
    there: OrbitLinearisation
    after: OrbitPassage
    step: float


def shift_point(
    period_map: PeriodMap, lead: float, middle: float, reach: float, index: int
) -> ShiftPoint | None:
    """The point `index` of the orbits at `lead` [rad] with V = middle + reach cos(chi).

    None where the orbit cannot be probed.
    """
    chi = (index + 0.5) * pi / SHIFT_POINTS
    found = _neighbours(period_map, lead, middle + reach * cos(chi))
    h = orbit_defect(found.orbit, found.here, _bend(found)) if found is not None else None
    if found is None or h is None:
        return None
    try:
        point = _point(period_map, found, h, reach * sin(chi))
    except ArithmeticError:
        return None
    return point if all(map(isfinite, (*point[:-1], *point.lags))) else None


def _point(period_map: PeriodMap, found: _Neighbours, h: float, reach: float) -> ShiftPoint:
    """The times; `reach` is the change of V by chi [m/s]."""
    linear = found.here.linear
    factor, decay = linear.factor, linear.factor * linear.slope
    squared = (decay / TOO_STEEP) ** 2
    counts = period_map.period / (1.0 + squared * squared)
    lags, of_turn = _lags(found, period_map.turns)
    shown = counts * (found.after.section - found.here.passage.section) / found.step
    lagging = hypot(linear.lag[1], linear.lag[2]) * period_map.swing / period_map.speed
    return ShiftPoint(
        gained=counts * h / (factor * factor) * reach / period_map.speed,
        shown=shown,
        of_turn=counts * of_turn,
        added_mass=factor - 1.0,
        swing=lagging * period_map.period / factor,
        unsure=min(UNSURE + abs(decay), 1.0),
        lags=[counts * lag + shown for lag in lags],
    )


def _neighbours(period_map: PeriodMap, lead: float, velocity: float) -> _Neighbours | None:
    step = -STEP if velocity > 0.0 else STEP
    try:
        here = held_orbit_linearised(period_map, held_orbit_at(period_map, lead, velocity))
        probe = orbit_probe(period_map, here)
        if probe is None:
            return None
        beside = held_orbit_at(period_map, lead, velocity + step * period_map.speed, here)
        there = held_orbit_linearised(period_map, beside)
    except NoOrbitError:
        return None
    linear = None if there.sticks else linearised(there.jacobian)
    if linear is None or not linear.is_slow:
        return None
    after = orbit_passage(period_map, there, linear, 0.0)
    return None if after is None else _Neighbours(here, probe, linear, after, step)


def _bend(found: _Neighbours) -> OrbitBend:
    here, there, step = found.here.linear, found.there, found.step
    return OrbitBend(
        (there.slope - here.slope) / step,
        (there.factor - here.factor) / step,
        [(b - a) / step for a, b in zip(here.tangent, there.tangent, strict=True)],
        [(b - a) / step for a, b in zip(here.lag, there.lag, strict=True)],
    )


def _lags(found: _Neighbours, turns: int) -> tuple[Vector, float]:
    """By how much V is ahead at the phases, in periods; the most by which single turns differ."""
    here, linear = found.here, found.here.linear
    decay = linear.factor * linear.slope
    lags, ways = [], []
    for i, n in enumerate(here.since):
        moved = velocity_by_excess(linear, n)
        by = (found.after.momentum[i] - here.passage.momentum[i]) / found.step
        way_by = (found.after.way[i] - here.passage.way[i]) / found.step
        travelled = (
            -0.5 * linear.factor * n * n if decay == 0.0 else (-linear.factor * n - moved) / decay
        )
        lags.append(-(here.momentum_by_excess[i] - by * moved) / (by * linear.factor))
        ways.append(here.way_by_excess[i] - travelled - way_by * moved)
    largest, turn = 0.0, (LAG_PHASES + turns // 2) // turns
    if turns > 1:
        largest = max(abs(ways[(i + turn) % LAG_PHASES] - ways[i]) for i in range(LAG_PHASES))
    return lags, turns * largest / linear.factor
