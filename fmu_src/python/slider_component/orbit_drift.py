"""Motion that drifts from orbit to orbit as its slow velocity changes."""

from __future__ import annotations

from math import exp, tau

from .held_orbit import HeldOrbit, NoOrbitError, OrbitStatus, SectionRate
from .moment import Moment
from .motion import State
from .period_map import PeriodMap


def held_orbit_moment(period_map: PeriodMap, orbit: HeldOrbit, load: float, theta: float) -> Moment:
    """The moment of a motion under `load` [N] at drive phase `theta` [rad], below 2 pi turns.

    Its slow velocity is that of the orbit just then: with its lag where the orbit is linearised,
    otherwise the moment is that of the orbit itself. Its position is what the fast motion adds to
    the integral of the slow velocity, 0 at the section. Raises NoOrbitError where the map fails.
    """
    plant = period_map.held.plant
    turned = (theta - orbit.section.theta) % (tau * period_map.turns)
    since = turned / plant.drive_frequency
    excess = load + orbit.friction if orbit.linearised and not orbit.sticks else 0.0
    # V and the excess decay at one rate: to second order in time what they were at the section.
    slowed = orbit.factor * excess / plant.total_mass
    decay = orbit.factor * orbit.slope / plant.total_mass * since
    faster = slowed * since * (1.0 + decay / 2.0 + decay * decay / 6.0)
    state, bristle = orbit.section.state, orbit.section.bristle
    state, bristle = _shifted(state, bristle, orbit.tangent, faster)
    state, bristle = _shifted(state, bristle, orbit.lag, excess * exp(decay))
    moment: Moment | None = period_map.enter(orbit.lead, orbit.section.theta, state, bristle)
    if moment is not None and since > 0.0:
        moment = period_map.advance(orbit.lead, excess - orbit.friction, moment, since)
    if moment is None:
        raise NoOrbitError(OrbitStatus.NOT_CONVERGED)
    moment.position -= (orbit.velocity + 0.5 * slowed * since * (1.0 + decay / 3.0)) * since
    return moment


def held_orbit_offset(period_map: PeriodMap, orbit: HeldOrbit, moment: Moment) -> float:
    """W - V [m/s] at a moment that belongs to the orbit."""
    return period_map.momentum_velocity(moment.state, moment.theta) - orbit.velocity


def _shifted(state: State, bristle: float, rate: SectionRate, amount: float) -> tuple[State, float]:
    shifted = State(*(a + amount * b for a, b in zip(state, rate.state, strict=True)))
    return shifted, bristle + amount * rate.bristle
