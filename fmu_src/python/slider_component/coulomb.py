"""Coulomb friction: mu sgn(X') per unit normal load, set-valued at rest.

Events are a stop of the slider (then it sticks if friction can hold it, and reverses otherwise), a
release, and the lift-off and touchdown of the contact.
"""

from cmath import rect

from .contact import BACKWARD, EXACT, FORWARD, LIFTED, STICK, direction_of
from .device import System
from .moment import Moment
from .segment import Segment, motion


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


def _needed_force(system: System, now: Moment) -> float:
    """Friction force [N] that holds a slider at rest."""
    held = system.spring * now.displacement + system.damper * now.rate - system.load
    return held + (system.direct * rect(1.0, now.theta)).imag


def _just_released(system: System, now: Moment) -> bool:
    """Whether the slider was released right now.

    Friction still balances the other forces; the mode alone shows where the slider departs to.
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
