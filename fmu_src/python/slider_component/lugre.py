"""LuGre friction (eq. 8): from one reversal to the next along the bristle's path.

Soon after a reversal the bristle is fully bent and friction is Coulomb's: closed forms take over.
Until then Taylor series follow the path. Its length falls with the bristle stiffness, so the cost
does not grow with that. There is no sticking: presliding is resolved as an oscillation on the
bristles.
"""

from __future__ import annotations

from math import inf

from . import refusal_texts
from .averaged_lugre import AVERAGED_LUGRE
from .contact import BACKWARD, FORWARD, LIFTED, direction_of, friction_limit
from .device import Device
from .friction_law import FrictionLaw
from .held import Held
from .leg import Leg, followed
from .moment import Moment
from .refusal import Refusal
from .regular_slide import RegularSlide
from .slide import slide
from .split_slide import SplitSlide
from .taylor_slide import TaylorSlide
from .velocity_scale import velocity_scale

TOLERANCE_SHARE = 0.01
"""Share of the tolerance for the error of one series, and for the bend that a bristle still lacks
when closed forms take over."""


def check(device: Device) -> None:
    """Raise Refusal without friction: (8) divides by mu."""
    if device.friction_coefficient == 0.0:
        raise Refusal(refusal_texts.lugre_without_friction(device.friction_coefficient))


def first_bristle(held: Held) -> float:
    """See FrictionLaw."""
    return held.bristle.stiffness * held.device.initial_bristle_deflection


def mode(held: Held, moment: Moment) -> int:
    """See FrictionLaw."""
    return held.mode_by_velocity(moment.state.velocity, moment.psi)


def force(held: Held, moment: Moment, mode: int) -> float:
    """Friction force [N] on the slider in contact mode `mode` (eq. 8), positive against +X."""
    if mode == LIFTED:
        return 0.0
    bristle, velocity, bent = held.bristle, moment.state.velocity, moment.bristle
    drag = velocity - abs(velocity) * bent / bristle.coefficient
    share = (bent + bristle.damping * drag) / bristle.coefficient
    return friction_limit(held.plant, moment.psi) * share


def follow(held: Held, now: Moment, longest: float, switching: float, departs: bool) -> Leg:
    """See FrictionLaw. The leg has the direction of the velocity or, at rest, of the force."""
    direction = BACKWARD if now.state.velocity < 0.0 else FORWARD
    motion = _motion(held, now, direction)
    if now.state.velocity == 0.0 and not _departs(motion):
        direction = BACKWARD
        motion = _motion(held, now, direction)
    if isinstance(motion, TaylorSlide):
        longest = min(longest, motion.reach)
    return followed(motion, held, now, direction, longest)


def succeed(held: Held, leg: Leg, now: Moment, switches: bool) -> None:
    """See FrictionLaw."""
    lifted = (leg.mode == LIFTED) != switches
    now.bristle = held.bristle.after(now.bristle, leg.travelled)
    now.mode = LIFTED if lifted else direction_of(now.state.velocity)
    if switches:
        now.event_age = 0.0


def _motion(held: Held, now: Moment, direction: int) -> SplitSlide | RegularSlide | TaylorSlide:
    """Motion in `direction`, in closed form where the bristle is fully bent."""
    plant, bristle = held.plant, held.bristle
    tolerance = TOLERANCE_SHARE * held.device.tolerance
    unbent = bristle.coefficient - direction * now.bristle
    if now.mode == LIFTED or abs(unbent) <= tolerance * bristle.coefficient:
        return slide(held, now, direction)
    allowed, chi = tolerance * velocity_scale(plant, now.state), now.psi + plant.phase
    return TaylorSlide(plant, bristle, direction, now.state, now.bristle, now.theta, chi, allowed)


def _departs(motion: SplitSlide | RegularSlide | TaylorSlide) -> bool:
    """Whether a slider at rest begins to move in the direction of `motion`, or not at all."""
    if isinstance(motion, TaylorSlide):
        return motion.departs()
    (watch,) = motion.watches(inf)
    return watch.signal(0.0)[1] >= 0.0


LUGRE = FrictionLaw(check, first_bristle, mode, force, follow, succeed, AVERAGED_LUGRE)
