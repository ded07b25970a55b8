"""What the slow equation leaves out, to second order in the excess force, measured on the map.

In the scales of the period map, E being the excess F2 + load of force, true slow motion is
v' = -f E + h E^2 with states x = x*(v) + xi E + eta E^2 and the mean velocity v; f is the factor
1 + kappa_m. The states a period later are those that v has then:

    (P_x - rho^2) eta - (x_v + F2' xi) rho k h = S - P_2,     X_x eta - k^2 h / 2 = s - X_2

P_2 and X_2 are the squares that the map of x* + xi E under E has, S and s those of the slow
equation without h, and k = (rho - 1) / ln(rho).
"""

from __future__ import annotations

from dataclasses import dataclass
from math import exp, expm1, isfinite, sin, tau
from typing import NamedTuple

from .held_orbit import HeldOrbit
from .linear_system import Vector, solve_linear
from .motion import State
from .orbit_equations import OrbitEquations
from .orbit_linearisation import OrbitLinearisation, linearised
from .period_map import PeriodMap
from .trace import Trace

LAG_PHASES = 8
"""Drive phases in a period, from 0 on, at which the motion is looked at."""

EXCESS = 1e-2
"""Excess force of the maps, in the scale of forces: its squares are far above rounding, its cubes
small."""

QUADRATURE_NODES = 4
"""How many nodes the integral over a part of an orbit has."""

NODES = (0.06943184420297371, 0.33000947820757187, 0.6699905217924281, 0.9305681557970263)
"""Gauss's nodes of the unit interval."""

WEIGHTS = (0.17392742256872693, 0.32607257743127307, 0.32607257743127307, 0.17392742256872693)
"""Their weights."""


class OrbitPassage(NamedTuple):
    """A motion through a period, in the scales of the period map.

    At the phases W and the slider's way less that of v since the section; where its section is from
    the mean place of the pair's centre, whose share of the vibration is left out; the values that
    the map has.
    """

    momentum: Vector
    way: Vector
    section: float
    values: Vector


@dataclass(frozen=True, slots=True)
class OrbitProbe:
    """A linearised orbit: its passage, what the excess adds to that, and the map's squares.

    `since` is the part of a period from the section to the phases.
    """

    linear: OrbitLinearisation
    passage: OrbitPassage
    momentum_by_excess: Vector
    way_by_excess: Vector
    since: Vector
    squares: Vector


@dataclass(frozen=True, slots=True)
class OrbitBend:
    """Derivatives by v of what linearisation gives."""

    slope: float
    factor: float
    tangent: Vector
    lag: Vector


def decayed_integral(decay: float, n: float) -> float:
    """The integral of exp(-decay t) up to `n`."""
    return n if decay == 0.0 else -expm1(-decay * n) / decay


def velocity_by_excess(linear: OrbitLinearisation, n: float) -> float:
    """The velocity that a unit of excess adds in `n` periods."""
    return -linear.factor * decayed_integral(linear.factor * linear.slope, n)


def orbit_passage(
    period_map: PeriodMap, orbit: HeldOrbit, linear: OrbitLinearisation, excess: float
) -> OrbitPassage | None:
    """Pass through the orbit, the `excess` times its lag off it. None where a map fails."""
    equations = OrbitEquations(period_map, orbit.lead, theta=orbit.section.theta)
    at = equations.unknowns(orbit.section.state, orbit.section.bristle, -orbit.friction)
    moved = [value + excess * lag for value, lag in zip(at, linear.lag, strict=False)]
    moved.append(at[-1] + excess)
    load, length = period_map.force * moved[-1], period_map.period * period_map.speed
    share, speed = period_map.held.plant.mass_fraction, orbit.velocity / period_map.speed
    start = _driven_way(period_map, orbit.section.theta)
    momentum, way, section = [0.0] * LAG_PHASES, [0.0] * LAG_PHASES, 0.0
    since, every = _parts_since(period_map, orbit), period_map.period / LAG_PHASES
    first = min(range(LAG_PHASES), key=lambda phase: since[phase])

    def see(index: int, state: State, position: float) -> None:
        nonlocal section
        phase = (first + index) % LAG_PHASES
        theta = tau * period_map.turns * phase / LAG_PHASES
        momentum[phase] = period_map.momentum_velocity(state, theta) / period_map.speed
        way[phase] = position / length - speed * since[phase]
        centre = share * state.displacement + _driven_way(period_map, theta) - start
        section -= (way[phase] + centre / length) / LAG_PHASES

    trace = Trace(since[first] * period_map.period, every, LAG_PHASES, see)
    begin = equations.section(moved)
    after = period_map.advance(orbit.lead, load, begin, period_map.period, trace)
    if after is None:
        return None
    values = equations.unknowns(after.state, after.bristle, load)[:-1]
    return OrbitPassage(momentum, way, section, [*values, after.position / length])


def orbit_probe(period_map: PeriodMap, orbit: HeldOrbit) -> OrbitProbe | None:
    """Probe a linearised orbit by three maps.

    None where one fails, where the slider sticks, and where its motion is not slow.
    """
    linear = None if orbit.sticks else linearised(orbit.jacobian)
    if linear is None or not linear.is_slow:
        return None
    less = orbit_passage(period_map, orbit, linear, -EXCESS)
    same = orbit_passage(period_map, orbit, linear, 0.0)
    more = orbit_passage(period_map, orbit, linear, EXCESS)
    if less is None or same is None or more is None:
        return None
    middles = zip(less.values, same.values, more.values, strict=True)
    return OrbitProbe(
        linear,
        same,
        _quotients(less.momentum, more.momentum, 2.0 * EXCESS),
        _quotients(less.way, more.way, 2.0 * EXCESS),
        _parts_since(period_map, orbit),
        [0.5 * (c + a - 2.0 * b) / (EXCESS * EXCESS) for a, b, c in middles],
    )


def orbit_defect(orbit: HeldOrbit, probe: OrbitProbe, bend: OrbitBend) -> float | None:
    """h of a probed orbit; None where there is none."""
    linear = probe.linear
    rho, moved = linear.multiplier, velocity_by_excess(linear, 1.0)
    stretch = decayed_integral(linear.factor * linear.slope, 1.0)
    end, mean = _slow_squares(linear, bend)
    excess = linear.slope * end + 0.5 * bend.slope * moved * moved
    states = len(linear.tangent)
    matrix, right = [], []
    for i in range(states):
        row = [orbit.jacobian[i][j] + (1.0 - rho * rho if i == j else 0.0) for j in range(states)]
        slow = linear.tangent[i] + linear.slope * linear.lag[i]
        matrix.append([*row, -slow * rho * stretch])
        right.append(
            linear.tangent[i] * end
            + 0.5 * bend.tangent[i] * moved * moved
            + bend.lag[i] * moved * rho
            + linear.lag[i] * excess
            - probe.squares[i]
        )
    matrix.append([*orbit.jacobian[states][:states], -0.5 * stretch * stretch])
    right.append(mean - probe.squares[states])
    found = solve_linear(matrix, right)
    return found[states] if found is not None and isfinite(found[states]) else None


def _quotients(before: Vector, after: Vector, step: float) -> Vector:
    return [(b - a) / step for a, b in zip(before, after, strict=True)]


def _parts_since(period_map: PeriodMap, orbit: HeldOrbit) -> Vector:
    """Parts of a period from the section of an orbit to the phases."""
    section = orbit.section.theta / (tau * period_map.turns)
    return [(phase / LAG_PHASES - section) % 1.0 for phase in range(LAG_PHASES)]


def _driven_way(period_map: PeriodMap, theta: float) -> float:
    """The way [m] of the pair's centre with the drive, against it."""
    return period_map.fast.pair_velocity / period_map.held.plant.drive_frequency * sin(theta)


def _slow_squares(linear: OrbitLinearisation, bend: OrbitBend) -> tuple[float, float]:
    """What the slow equation without h adds by the square of the excess.

    To v in a period, and to its mean.
    """
    decay = linear.factor * linear.slope
    end = mean = 0.0
    for t, weight in zip(NODES, WEIGHTS, strict=True):
        moved = velocity_by_excess(linear, t)
        pull = bend.factor * moved * exp(-decay * t)
        pull += 0.5 * linear.factor * bend.slope * moved * moved
        end -= weight * pull * exp(-decay * (1.0 - t))
        mean -= weight * pull * decayed_integral(decay, 1.0 - t)
    return end, mean
