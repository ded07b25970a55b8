"""Motion that drifts from orbit to orbit as its slow velocity changes."""

from __future__ import annotations

from math import exp, expm1, sqrt, tau

from .held_orbit import HeldOrbit, NoOrbitError, OrbitStatus, SectionRate
from .moment import Moment
from .motion import State
from .period_map import PeriodMap

ERROR_OF_WAVES = 0.012
"""Error of slow motion over the square of the change of V in a period, both in v_q.

With the root of the waves of the normal load in a turn of the drive, one at least. Fitted, with the
next three, to transients of random devices with a friction share up to 0.1."""

ERROR_OF_MEMORY = 0.0025
"""The same with the periods that the resonator remembers."""

ERROR_OF_ADDED_MASS = 2.5
"""The same with the added mass over the total one."""

ERROR_OF_FLIGHT = 0.2
"""The same with the change of V, in flight, for the kinks of its curves."""


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


def drift_error(period_map: PeriodMap, factor: float, excess: float) -> float:
    """Estimate of the error [m/s] that slow motion makes.

    On its way from an excess F2 + load [N] of force with `factor` 1 + kappa_m: of second order in
    the change of the slow velocity in a period.
    """
    device = period_map.held.device
    waves = max(1.0, abs(period_map.held.inputs.frequency_ratio))
    change = abs(factor * excess) / period_map.force
    share = ERROR_OF_WAVES * sqrt(waves) + ERROR_OF_MEMORY * _memory(period_map)
    share += ERROR_OF_ADDED_MASS * abs(factor - 1.0)
    if device.normal_amplitude > device.normal_preload:
        share += ERROR_OF_FLIGHT * change
    return period_map.speed * min(1.0, share * change * change)


def _memory(period_map: PeriodMap) -> float:
    """Periods that the resonator remembers, the present one included."""
    slip = period_map.held.plant.slip
    excess = slip.decay * slip.decay - slip.stiffness
    slowest = slip.stiffness / (slip.decay + sqrt(excess)) if excess > 0.0 else slip.decay
    return -1.0 / expm1(-slowest * period_map.period)


def _shifted(state: State, bristle: float, rate: SectionRate, amount: float) -> tuple[State, float]:
    shifted = State(*(a + amount * b for a, b in zip(state, rate.state, strict=True)))
    return shifted, bristle + amount * rate.bristle
