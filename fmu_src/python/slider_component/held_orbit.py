"""Held orbits: the periodic motion of the full device whose mean velocity is held at V.

The load that holds it is L = -F2(V), F2 the mean friction. The unknowns are the state at the
section and L; the equations are that the state repeats after a period, and that the displacement in
a period is V times the period. This fixed point of the period map is found by Newton's method, with
sliding, sticking and flight alike.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import IntEnum
from math import copysign
from typing import NamedTuple

from .contact import BACKWARD, FORWARD, STICK
from .fast_vibration import steady_swing
from .linear_system import Matrix, Vector
from .moment import Moment
from .motion import State
from .orbit_equations import OrbitEquations
from .orbit_linearisation import largest_multiplier, linearised
from .orbit_newton import solved, unknowns_after
from .oscillator import transfer
from .period_map import PeriodMap

SAME_FRICTION = 1e-6
"""Difference of mean friction, over that of sliding, up to which orbits are the same."""

NEUTRAL = 1.0 + 1e-4
"""Multiplier from which on motion leaves an orbit; 1, but for differences, where it slides on."""

SECTION_REACH = 0.5
"""Largest velocity against the direction of a section, in v_q, at which the section is used."""


class OrbitStatus(IntEnum):
    """Why there is no orbit; texts are those of `NoOrbitError`."""

    UNDAMPED = 1
    STILL = 2
    NOT_CONVERGED = 3
    UNSTABLE = 4
    RUNS_AWAY = 5
    UNDETERMINED = 6
    NOT_SLOW = 7


class NoOrbitError(RuntimeError):
    """There is no orbit, or none was found, for the reason `status`.

    UNDAMPED: without damping the start of the resonator never decays. STILL: nothing vibrates, or
    friction holds the slider at rest throughout. NOT_CONVERGED: Newton's method does not converge.
    UNSTABLE: the vibration about the orbit does not decay. RUNS_AWAY: the load exceeds all
    friction, so that no velocity is steady. UNDETERMINED: the load leaves several velocities
    steady, or several motions one velocity. NOT_SLOW: bristles follow no faster than the velocity
    changes.
    """

    def __init__(self, status: OrbitStatus) -> None:
        super().__init__(status.name)
        self.status = status


class SectionRate(NamedTuple):
    """A change of the state at the section and of the friction of the bristle there."""

    state: State
    bristle: float


NO_RATE = SectionRate(State(0.0, 0.0, 0.0), 0.0)


@dataclass(frozen=True, slots=True)
class HeldOrbit:
    """An orbit of mean velocity [m/s] and mean friction F2 [N].

    `lead` [rad] is the phase of the normal load at drive phase 0. `section` is the moment at the
    section, in `direction`; motion from there on under the load -friction is the orbit, see
    `held_orbit_moment`. `reversals` is their number in a period; `sticks`: the slider sticks in a
    period. `maps` is the number of period maps that it took. `jacobian` is that of its equations,
    in their scales.

    Known once it is `linearised`: `factor` 1 + kappa_m, 1 until then and where the slider sticks;
    `slope` F2' = dF2/dV [N s/m]; `fast_multiplier`, the largest multiplier of a period of the
    vibration about the orbit; `tangent`, the derivative of the section by velocity [m/s]; `lag`,
    the change of the section in a motion that drifts, per excess force F2 + load [N].
    """

    lead: float
    velocity: float
    friction: float
    direction: int
    section: Moment
    reversals: int
    sticks: bool
    maps: int
    jacobian: Matrix
    factor: float = 1.0
    slope: float = 0.0
    fast_multiplier: float = 0.0
    tangent: SectionRate = NO_RATE
    lag: SectionRate = NO_RATE
    linearised: bool = False


def held_orbit_at(
    period_map: PeriodMap, lead: float, velocity: float, neighbour: HeldOrbit | None = None
) -> HeldOrbit:
    """The orbit at `velocity` [m/s], starting from a neighbour if there is one.

    Raises NoOrbitError.
    """
    _check(period_map)
    equations = OrbitEquations(period_map, lead, given=velocity / period_map.speed)
    if neighbour is not None and _section_serves(period_map, neighbour.direction, velocity):
        return _found(equations, neighbour.direction, neighbour)
    return _found(equations, FORWARD if velocity >= 0.0 else BACKWARD, None)


def steady_orbit_at(
    period_map: PeriodMap, lead: float, load: float, neighbour: HeldOrbit | None = None
) -> HeldOrbit:
    """The orbit that `load` [N] holds: the steady motion under this load.

    Raises NoOrbitError.
    """
    _check(period_map)
    given = load / period_map.force
    direction = neighbour.direction if neighbour is not None else FORWARD
    equations = OrbitEquations(period_map, lead, given=given, loaded=True)
    orbit = _found(equations, direction, neighbour)
    if _section_serves(period_map, direction, orbit.velocity):
        return orbit
    orbit = held_orbit_at(period_map, lead, orbit.velocity, orbit)
    return _found(equations, orbit.direction, orbit)


def held_orbit_linearised(period_map: PeriodMap, orbit: HeldOrbit) -> HeldOrbit:
    """The orbit, linearised, at the cost of one map more than it has unknowns.

    LuGre friction needs this always, Coulomb friction for slope, lag and low damping. Raises
    NoOrbitError.
    """
    equations = OrbitEquations(period_map, orbit.lead, theta=orbit.section.theta, maps=orbit.maps)
    unknowns = equations.unknowns(orbit.section.state, orbit.section.bristle, -orbit.friction)
    trial = equations.attempt(unknowns)
    jacobian = equations.jacobian(unknowns, trial) if trial is not None else None
    linear = linearised(jacobian) if jacobian is not None else None
    if jacobian is None or linear is None:
        raise NoOrbitError(OrbitStatus.NOT_CONVERGED)
    if not linear.fast_multiplier < 1.0:
        raise NoOrbitError(OrbitStatus.UNSTABLE)
    if period_map.states > 3 and not orbit.sticks and not linear.is_separate:
        raise NoOrbitError(OrbitStatus.NOT_SLOW)
    drifts = linear.is_slow and not orbit.sticks
    scales = period_map
    return replace(
        orbit,
        maps=equations.maps,
        jacobian=jacobian,
        factor=linear.factor if drifts else 1.0,
        slope=linear.slope * scales.force / scales.speed,
        fast_multiplier=linear.fast_multiplier,
        tangent=_section_rate(scales, orbit.section.theta, linear.tangent, scales.speed),
        lag=_section_rate(scales, orbit.section.theta, linear.lag, scales.force)
        if drifts
        else NO_RATE,
        linearised=True,
    )


def check_stable(period_map: PeriodMap, orbit: HeldOrbit) -> None:
    """Raise NoOrbitError where motion under the load of the orbit leaves it.

    That costs as many maps as there are unknowns, and one.
    """
    equations = OrbitEquations(period_map, orbit.lead, theta=orbit.section.theta)
    unknowns = equations.unknowns(orbit.section.state, orbit.section.bristle, -orbit.friction)
    trial = equations.attempt(unknowns)
    jacobian = equations.jacobian(unknowns, trial) if trial is not None else None
    if jacobian is None:
        raise NoOrbitError(OrbitStatus.NOT_CONVERGED)
    if not largest_multiplier(jacobian) < NEUTRAL:
        raise NoOrbitError(OrbitStatus.UNSTABLE)


def is_same_orbit(period_map: PeriodMap, one: HeldOrbit, other: HeldOrbit) -> bool:
    """Whether two orbits of one lead and velocity are the same: their friction is."""
    sliding = period_map.sliding_friction(one.lead)
    return abs(one.friction - other.friction) <= SAME_FRICTION * sliding


def _check(period_map: PeriodMap) -> None:
    """Raise NoOrbitError where there can be no orbit at all."""
    if not period_map.held.device.damping_ratio > 0.0:
        raise NoOrbitError(OrbitStatus.UNDAMPED)
    if not period_map.speed > 0.0:
        raise NoOrbitError(OrbitStatus.STILL)


def _section_serves(period_map: PeriodMap, direction: int, velocity: float) -> bool:
    """Whether the section in `direction` may be used for orbits at `velocity` [m/s]."""
    return direction * velocity > -SECTION_REACH * period_map.speed


def _section_rate(period_map: PeriodMap, theta: float, change: Vector, per: float) -> SectionRate:
    equations = OrbitEquations(period_map, 0.0, theta=theta)
    none = equations.section([0.0] * (len(change) + 1))
    moved = equations.section([*(value / per for value in change), 0.0])
    state = State(
        moved.state.velocity - none.state.velocity, moved.state.displacement, moved.state.rate
    )
    return SectionRate(state, moved.bristle)


def _found(equations: OrbitEquations, direction: int, neighbour: HeldOrbit | None) -> HeldOrbit:
    scales = equations.map
    equations.theta = scales.section_phase(direction)
    start = _along_tangent(equations, neighbour) if neighbour is not None else None
    jacobian = neighbour.jacobian if neighbour is not None and start is not None else None
    unknowns = start if start is not None else _vibration_alone(equations, direction)
    trial = equations.attempt(unknowns)
    if trial is None:
        raise NoOrbitError(OrbitStatus.NOT_CONVERGED)
    solution = solved(equations, unknowns, trial, jacobian)
    if solution is None:
        rests = _stays_at_rest(equations)
        raise NoOrbitError(OrbitStatus.STILL if rests else OrbitStatus.NOT_CONVERGED)
    unknowns, trial, mean_velocity, jacobian = solution
    velocity = scales.speed * (mean_velocity if equations.loaded else equations.given)
    friction = -scales.force * unknowns[-1]
    slides = trial.after.counts.reversals == 0 and trial.after.counts.sticks == 0
    if slides and not equations.loaded:
        friction = copysign(scales.sliding_friction(equations.lead), velocity)
    return HeldOrbit(
        lead=equations.lead,
        velocity=velocity,
        friction=friction,
        direction=direction,
        section=equations.section(unknowns),
        reversals=trial.after.counts.reversals,
        sticks=trial.after.counts.sticks > 0,
        maps=equations.maps,
        jacobian=jacobian,
    )


def _along_tangent(equations: OrbitEquations, neighbour: HeldOrbit) -> Vector | None:
    """The first guess on the tangent at a neighbour; None where its Jacobian is singular."""
    section = neighbour.section
    unknowns = equations.unknowns(section.state, section.bristle, -neighbour.friction)
    values = [0.0] * (len(unknowns) - 1) + [neighbour.velocity / equations.map.speed]
    step = equations.newton_step(neighbour.jacobian, values, unknowns)
    return None if step is None else unknowns_after(unknowns, step, 1.0)


def _vibration_alone(equations: OrbitEquations, direction: int) -> Vector:
    """The vibration without friction at the section: the first guess without a neighbour."""
    scales = equations.map
    frequency = scales.held.plant.drive_frequency
    displacement, rate = steady_swing(scales.fast.resonator, equations.theta, frequency)
    velocity = 0.0 if equations.loaded else equations.given
    state = State(scales.speed * (velocity + direction), displacement, rate)
    load = equations.given * scales.force if equations.loaded else 0.0
    return equations.unknowns(state, direction * scales.held.bristle.coefficient, load)


def _stays_at_rest(equations: OrbitEquations) -> bool:
    """Whether the slider stays at rest on a resonator that vibrates steadily."""
    scales, plant = equations.map, equations.map.held.plant
    load = equations.given * scales.force if equations.loaded else 0.0
    swing = plant.base_acceleration * transfer(plant.stick, plant.drive_frequency)
    displacement, rate = steady_swing(swing, 0.0, plant.drive_frequency)
    rest = scales.enter(equations.lead, 0.0, State(0.0, displacement, rate), 0.0)
    after = scales.advance(equations.lead, load, rest, scales.period)
    return after is not None and after.mode == STICK and after.position == 0.0
