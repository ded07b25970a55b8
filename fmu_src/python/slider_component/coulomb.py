"""Coulomb friction: closed-form motion from one event to the next.

Events are a stop of the slider (then it sticks if friction can hold it, and reverses otherwise), a
release, and the lift-off and touchdown of the contact. There is no step size and no tolerance.
"""

from __future__ import annotations

from math import cos, sin

from .averaged_coulomb import AVERAGED_COULOMB
from .contact import BACKWARD, FORWARD, LIFTED, STICK, direction_of, friction_limit
from .departure import departure_time
from .device import Device
from .friction_law import FrictionLaw
from .held import Held
from .leg import Leg, followed
from .moment import Moment
from .motion import EPSILON
from .plant import Plant
from .slide import slide
from .stick import Stick

SAME = 1e-6
"""Share of the longest arc within which a release and a lift-off may be the same event."""

BALANCED = 1e-12
"""Relative difference of the forces on a slider up to which they count as balanced."""


def check(device: Device) -> None:
    """Coulomb friction has a meaning for any device."""


def first_bristle(held: Held) -> float:
    """Coulomb friction has no bristle."""
    return 0.0


def mode(held: Held, moment: Moment) -> int:
    """Contact mode under the held inputs."""
    if held.lifted_at(moment.psi):
        return LIFTED
    released = _just_released(held.plant, moment)
    return moment.mode if released else _mode_in_contact(held.plant, moment)


def force(held: Held, moment: Moment, mode: int) -> float:
    """Friction force [N] on the slider in contact mode `mode`, positive against +X."""
    if mode == LIFTED:
        return 0.0
    if mode == STICK:
        return _needed_force(held.plant, moment)
    return mode * friction_limit(held.plant, moment.psi)


def follow(held: Held, now: Moment, longest: float, switching: float, departs: bool) -> Leg:
    """See FrictionLaw."""
    plant, chi = held.plant, now.psi + held.plant.phase
    if now.mode == STICK:
        leg = followed(Stick(plant, now.state, now.theta, chi), held, now, 0, longest)
        near_switch = switching == longest and switching - leg.t < SAME * held.arc
        chi += plant.normal_frequency * leg.t
        if leg.released and near_switch and _lifts_first(plant, chi):
            leg.t, leg.zero_of = switching, None
        return leg
    direction = 0 if now.mode == LIFTED else now.mode
    watched_from = 0.0
    if direction != 0 and departs:
        watched_from = departure_time(plant, direction, now.state, now.theta, chi)
    return followed(slide(held, now, direction), held, now, direction, longest, watched_from)


def succeed(held: Held, leg: Leg, now: Moment, switches: bool) -> None:
    """See FrictionLaw."""
    if leg.zero_of is not None:
        if leg.rests:
            now.enter(FORWARD if leg.zero_of == 0 else BACKWARD)
        else:
            now.enter(_mode_in_contact(held.plant, now))
    elif switches:
        now.enter(_mode_in_contact(held.plant, now) if leg.mode == LIFTED else LIFTED)


def _needed_force(plant: Plant, moment: Moment) -> float:
    """Friction force [N] that holds a slider at rest."""
    state, direct, theta = moment.state, plant.holding_drive, moment.theta
    resonator = plant.spring * state.displacement + plant.damper * state.rate
    if not direct:
        return resonator - plant.load
    return resonator - plant.load + direct.real * sin(theta) + direct.imag * cos(theta)


def _just_released(plant: Plant, moment: Moment) -> bool:
    """Whether the slider was released right now.

    Friction still balances the other forces, and only the mode of the moment shows in which
    direction the slider departs.
    """
    if moment.state.velocity != 0.0 or moment.mode not in (FORWARD, BACKWARD):
        return False
    limit = friction_limit(plant, moment.psi)
    excess = moment.mode * _needed_force(plant, moment) - limit
    return abs(excess) <= BALANCED * (limit + plant.friction_preload + abs(plant.load))


def _mode_in_contact(plant: Plant, moment: Moment) -> int:
    if moment.state.velocity != 0.0:
        return direction_of(moment.state.velocity)
    needed = _needed_force(plant, moment)
    # In most cases the largest limit decides, without a sine.
    limit = plant.friction_preload + plant.friction_amplitude
    if -limit <= needed <= limit:
        limit = friction_limit(plant, moment.psi)
    if needed > limit:
        return FORWARD
    return BACKWARD if needed < -limit else STICK


def _lifts_first(plant: Plant, chi: float) -> bool:
    """Whether a stick ends because the contact lifts: friction is 0 there."""
    limit = plant.friction_preload + plant.friction_amplitude * sin(chi)
    return limit <= 16.0 * EPSILON * (plant.friction_preload + plant.friction_amplitude)


COULOMB = FrictionLaw(check, first_bristle, mode, force, follow, succeed, AVERAGED_COULOMB)
