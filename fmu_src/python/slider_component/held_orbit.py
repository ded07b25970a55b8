"""Held orbits: the periodic motion of the full device whose mean velocity is held at V.

The load that holds it is L = -F2(V), F2 the mean friction. Unknown are the state at the section and
L, given that the state repeats after a period and that the way in it is V times the period: a fixed
point of the period map, found by Newton's method, with sliding, sticking and flight alike.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import IntEnum
from math import copysign, inf
from typing import NamedTuple

from .contact import BACKWARD, FORWARD, STICK
from .fast_vibration import steady_swing
from .linear_system import Matrix, Vector
from .moment import Moment
from .motion import State
from .orbit_equations import DIFFERENCE, OrbitEquations, Trial, largest
from .orbit_linearisation import largest_multiplier, linearised
from .oscillator import transfer
from .period_map import PeriodMap

MAX_MAPS = 120
"""Maps that an orbit may take, Jacobians included, before it counts as not found."""

COULOMB_CONVERGED = 1e-13
"""Correction of the unknowns in their scales up to which an orbit is found."""

LUGRE_CONVERGED = 1e-12
"""The same under LuGre friction."""

ROUNDED = 1e-9
"""Correction up to which an orbit is found where rounding ends the decrease of corrections."""

SAME_FRICTION = 1e-6
"""Difference of mean friction, over that of sliding, up to which orbits are the same."""

NEUTRAL = 1.0 + 1e-4
"""Multiplier from which on motion leaves an orbit; 1, but for differences, where it slides on."""

SECTION_REACH = 0.5
"""Velocity against the direction of a section, in v_q, up to which the section serves."""

SMALLEST_PART = 0.015
"""Smallest part of a step that is tried."""


class OrbitStatus(IntEnum):
    """Why there is no orbit; texts are those of `NoOrbitError`."""

    FOUND = 0
    UNDAMPED = 1
    STILL = 2
    NOT_CONVERGED = 3
    UNSTABLE = 4
    RUNS_AWAY = 5
    UNDETERMINED = 6
    NOT_SLOW = 7


class NoOrbitError(RuntimeError):
    """There is no orbit, or none was found, for the reason `status`.

    UNDAMPED: without damping the resonator never forgets its start. STILL: nothing vibrates, or
    friction holds the slider at rest throughout. NOT_CONVERGED: Newton's method does not settle.
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
    section, in `direction`: motion under the load -friction goes on from there, see
    `held_orbit_moment`. `reversals` in a period, and whether the slider `sticks` in it. `maps` is
    how often the period was mapped for this orbit. `jacobian` is that of its equations, in their
    scales.

    Known once it is `linearised`: `factor` 1 + kappa_m, 1 until then and where the slider sticks;
    `slope` F2' = dF2/dV [N s/m]; `fast_multiplier`, the largest one by which vibration about the
    orbit decays in a period; `tangent` by velocity [m/s]; and the `lag` of a motion that drifts, by
    the excess F2 + load [N] of force.
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
    """The orbit at `velocity` [m/s], from that of a neighbour if there is one.

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
    """The orbit in which `load` [N] is the one that holds: the steady motion under it.

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
    """The orbit with what is known once it is linearised.

    That costs as many maps as it has unknowns, and one. It is needed under LuGre friction, and
    under Coulomb friction for the slope, the error and low damping. Raises NoOrbitError.
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
    """Whether the section in `direction` serves orbits at `velocity` [m/s]."""
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
    try:
        unknowns, trial, mean_velocity, jacobian = _solved(equations, unknowns, trial, jacobian)
    except NoOrbitError as error:
        raise NoOrbitError(OrbitStatus.STILL) if _stays_at_rest(equations) else error from None
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
    """Where the tangent at a neighbour leads; None where it has none."""
    section = neighbour.section
    unknowns = equations.unknowns(section.state, section.bristle, -neighbour.friction)
    values = [0.0] * (len(unknowns) - 1) + [neighbour.velocity / equations.map.speed]
    step = equations.newton_step(neighbour.jacobian, values, unknowns)
    return None if step is None else _advanced(unknowns, step, 1.0)


def _vibration_alone(equations: OrbitEquations, direction: int) -> Vector:
    """The vibration without friction at the section: where the search begins without neighbour."""
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


def _solved(
    equations: OrbitEquations, unknowns: Vector, trial: Trial, known: Matrix | None
) -> tuple[Vector, Trial, float, Matrix]:
    """Newton's method from `unknowns`, damped, with the Jacobian kept as long as it serves.

    Returns unknowns, trial, mean velocity and Jacobian at the orbit.
    """
    accuracy = LUGRE_CONVERGED if equations.map.states > 3 else COULOMB_CONVERGED
    jacobian, fresh = known, False
    before = inf
    while equations.maps < MAX_MAPS:
        if jacobian is None:
            jacobian, fresh = equations.jacobian(unknowns, trial), True
            if jacobian is None:
                break
        step = equations.newton_step(jacobian, trial.values, unknowns)
        size = largest(step)
        if step is not None and (size <= accuracy or (size <= ROUNDED and size > 0.5 * before)):
            mean = trial.values[-1] + sum(a * b for a, b in zip(jacobian[-1], step, strict=True))
            return _advanced(unknowns, step, 1.0), trial, mean, jacobian
        accepted = _accepted(equations, unknowns, jacobian, step, fresh)
        if accepted is not None:
            following, other, part = accepted
            if part * size > DIFFERENCE:
                jacobian = _updated(jacobian, unknowns, trial, following, other)
            unknowns, trial, fresh, before = following, other, False, size
        elif size <= ROUNDED:
            return unknowns, trial, trial.values[-1], jacobian
        elif fresh:
            break
        else:
            jacobian = None
    raise NoOrbitError(OrbitStatus.NOT_CONVERGED)


def _accepted(
    equations: OrbitEquations, unknowns: Vector, jacobian: Matrix, step: Vector | None, fresh: bool
) -> tuple[Vector, Trial, float] | None:
    """The unknowns to which the largest part of a step leads that comes closer, and that part.

    Parts are tried of the step of a fresh Jacobian alone.
    """
    part, size = 1.0, largest(step)
    while step is not None and part > SMALLEST_PART and equations.maps < MAX_MAPS:
        following = _advanced(unknowns, step, part)
        other = equations.attempt(following)
        if other is not None:
            left = largest(equations.newton_step(jacobian, other.values, following))
            if left <= (1.0 - 0.25 * part) * size:
                return following, other, part
        if not fresh or size <= ROUNDED:
            break
        part *= 0.25
    return None


def _advanced(unknowns: Vector, step: Vector, part: float) -> Vector:
    return [a + part * b for a, b in zip(unknowns, step, strict=True)]


def _updated(
    jacobian: Matrix, unknowns: Vector, trial: Trial, following: Vector, other: Trial
) -> Matrix:
    """Broyden's update: the Jacobian that takes the move to the change of the values.

    It is else the same.
    """
    moved = [a - b for a, b in zip(following, unknowns, strict=True)]
    square = sum(a * a for a in moved)
    updated = []
    for row, after, before in zip(jacobian, other.values, trial.values, strict=True):
        missed = after - before - sum(a * b for a, b in zip(row, moved, strict=True))
        updated.append([a + missed * b / square for a, b in zip(row, moved, strict=True)])
    return updated
