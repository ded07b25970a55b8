"""Coulomb friction: mu sgn(X') per unit normal load, set-valued at rest.

Events are a stop of the slider (then it sticks if friction can hold it, and reverses otherwise), a
release, and the lift-off and touchdown of the contact.
"""

from cmath import rect

from .contact import BACKWARD, FORWARD, LIFTED, STICK, direction_of
from .device import System
from .moment import Moment
from .series import Series
from .sliding import Exponentials

Segment = Exponentials | Series
"""Motion from a moment on, inputs held, contact mode unchanged."""

BALANCED = 1e-12
"""Relative difference of the forces on a slider up to which they count as balanced."""


class Coulomb:
    """A friction law, as the loop over events needs it."""

    def mode(self, system: System, now: Moment) -> int:
        """Contact mode under the held inputs."""
        if system.is_lifted(now.psi):
            return LIFTED
        return now.mode if _just_released(system, now) else _mode_in_contact(system, now)

    def force(self, system: System, now: Moment, mode: int) -> float:
        """Friction force [N] on the slider in contact mode `mode`, positive against +X."""
        if mode == LIFTED:
            return 0.0
        if mode == STICK:
            return _needed_force(system, now)
        return mode * system.friction_limit(now.psi)

    def begin(self, system: System, now: Moment) -> Segment:
        """The motion on from `now`."""
        if now.mode == STICK:
            split = system.rest_split is not None
            return (Exponentials if split else Series)(system, now, 0, rests=True)
        return slide(system, now, 0 if now.mode == LIFTED else now.mode)

    def enter_next_mode(
        self, system: System, now: Moment, travelled: float, zero_of: int | None, switches: bool
    ) -> None:
        """Change from the end of a segment to the next contact mode.

        After a displacement `travelled` [m]; `zero_of` is the index of the watched signal whose
        zero ends the segment, or None; it `switches` where the contact lifts or touches down.
        """
        if zero_of is not None and now.mode == STICK:
            now.enter(FORWARD if zero_of == 0 else BACKWARD)
        elif zero_of is not None:
            now.enter(_mode_in_contact(system, now))
        elif switches:
            now.enter(_mode_in_contact(system, now) if now.mode == LIFTED else LIFTED)


def slide(system: System, now: Moment, direction: int) -> Segment:
    """Sliding in `direction` under full friction, or flight in contact mode LIFTED.

    The velocity is watched in `direction`, unless that is 0.
    """
    return (Series if system.slide_split is None else Exponentials)(system, now, direction)


def _needed_force(system: System, now: Moment) -> float:
    """Friction force [N] that holds a slider at rest."""
    held = system.spring * now.displacement + system.damper * now.rate - system.load
    return held + (system.direct * rect(1.0, now.theta)).imag


def _just_released(system: System, now: Moment) -> bool:
    """Whether the slider was released right now.

    Friction still balances the other forces, and only the mode of the moment shows in which
    direction the slider departs.
    """
    if now.velocity != 0.0 or now.mode not in (FORWARD, BACKWARD):
        return False
    limit = system.friction_limit(now.psi)
    excess = now.mode * _needed_force(system, now) - limit
    return abs(excess) <= BALANCED * (limit + system.friction_preload + abs(system.load))


def _mode_in_contact(system: System, now: Moment) -> int:
    if now.velocity != 0.0:
        return direction_of(now.velocity)
    needed, limit = _needed_force(system, now), system.friction_limit(now.psi)
    if needed > limit:
        return FORWARD
    return BACKWARD if needed < -limit else STICK
