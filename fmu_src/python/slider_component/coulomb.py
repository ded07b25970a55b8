"""Coulomb friction: mu sgn(X') per unit normal load, set-valued at rest.

Events are a stop of the slider (then it sticks if friction can hold it, and reverses otherwise), a
release, and the lift-off and touchdown of the contact.
"""

from cmath import rect

from .closed_form import ClosedForm
from .contact import BACKWARD, EXACT, FORWARD, LIFTED, STICK, direction_of
from .device import System
from .moment import Moment
from .series import Series

Segment = ClosedForm | Series
"""Motion from a moment on, inputs held, contact mode unchanged."""


class Coulomb:
    """A friction law, as the loop over events needs it."""

    def mode(self, system: System, now: Moment) -> int:
        """Contact mode under the held inputs, in contact."""
        return now.mode if _just_released(system, now) else _mode_in_contact(system, now)

    def force(self, system: System, now: Moment, mode: int) -> float:
        """Friction force [N] on the slider in contact mode `mode`, positive against +X."""
        return mode * system.friction_limit(now.psi) if mode else _needed_force(system, now)

    def begin(self, system: System, now: Moment) -> Segment:
        """The motion on from `now`."""
        return motion(system, now, 0 if now.mode == LIFTED else now.mode)

    def enter_next_mode(
        self, system: System, now: Moment, travelled: float, zero_of: int | None, switches: bool
    ) -> None:
        """Change from the end of a segment to the next contact mode.

        After a displacement `travelled` [m]; `zero_of` is the index of the watched signal whose
        zero ends the segment, or None; it `switches` where the contact lifts or touches down.
        """
        if zero_of is not None and now.mode == STICK:
            now.enter(FORWARD if zero_of == 0 else BACKWARD)
        elif switches and now.mode != LIFTED:
            now.enter(LIFTED)
        elif switches or zero_of is not None:
            now.enter(_mode_in_contact(system, now))


def motion(system: System, now: Moment, direction: int) -> Segment:
    """Sliding in `direction` under full friction, flight in contact mode LIFTED, or rest.

    The velocity is watched in `direction`, unless that is 0.
    """
    mode = system.free if direction or now.mode == LIFTED else system.held
    return (Series if mode.responses is None else ClosedForm)(system, now, direction)


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
    return abs(excess) <= EXACT * (limit + system.friction_preload + abs(system.load))


def _mode_in_contact(system: System, now: Moment) -> int:
    if now.velocity != 0.0:
        return direction_of(now.velocity)
    needed, limit = _needed_force(system, now), system.friction_limit(now.psi)
    if needed > limit:
        return FORWARD
    return BACKWARD if needed < -limit else STICK
