"""LuGre friction (eq. 8): from one reversal to the next along the bristle's path.

With s the direction of sliding, g = sigma_0 z the friction of the bristle and g_r its value where a
segment starts, the bristle is a function of the path alone:

    g = s mu + (g_r - s mu) exp(-sigma_0 |x - x_r| / mu)

Taylor series of (8) follow the motion while it bends. Then it is fully bent, friction is Coulomb's,
and closed forms take over: no stiff state remains, and the cost does not grow with the stiffness.
There is no sticking: presliding is resolved as an oscillation on the bristles.
"""

from math import copysign, expm1

from .contact import FORWARD, LIFTED, direction_of
from .device import System
from .moment import Moment
from .segment import Segment, Series, motion


class LuGre:
    """A friction law, with the methods of `Coulomb`."""

    def mode(self, system: System, now: Moment) -> int:
        """As of `Coulomb`: presliding is no sticking."""
        return direction_of(now.velocity)

    def force(self, system: System, now: Moment, mode: int) -> float:
        """As of `Coulomb` (eq. 8)."""
        mu = system.device.friction_coefficient
        drag = now.velocity - abs(now.velocity) * now.bristle / mu
        share = (now.bristle + system.device.bristle_damping * drag) / mu
        return system.friction_limit(now.psi) * share

    def begin(self, system: System, now: Moment) -> Segment:
        """As of `Coulomb`. At rest the direction is the one in which the slider soon moves."""
        direction = direction_of(now.velocity) or -now.sliding or FORWARD
        segment = _segment(system, now, direction)
        if now.velocity == 0.0:
            # After a thousandth of a radian, or of a series, the slider still moves as it began.
            soon = 1e-3 * min(segment.reach, 1.0 / system.fastest)
            if direction * segment.at(soon)[0] < 0.0:
                segment = _segment(system, now, -direction)
        return segment

    def enter_next_mode(
        self, system: System, now: Moment, travelled: float, zero_of: int | None, switches: bool
    ) -> None:
        """As of `Coulomb`."""
        device, lifted = system.device, (now.mode == LIFTED) != switches
        mu, limit = device.friction_coefficient, copysign(device.friction_coefficient, travelled)
        bent = -expm1(-device.bristle_stiffness * abs(travelled) / mu)
        now.bristle += (limit - now.bristle) * bent
        now.mode = LIFTED if lifted else direction_of(now.velocity)
        if switches:
            now.last_event_time = now.time


def _segment(system: System, now: Moment, direction: int) -> Segment:
    """Motion in `direction`, in closed form where the bristle is fully bent.

    A hundredth of the tolerance is for the bend that it lacks there, and for the error of a series.
    """
    mu, tolerance = system.device.friction_coefficient, 0.01 * system.device.tolerance
    if now.mode == LIFTED or abs(mu - direction * now.bristle) <= tolerance * mu:
        return motion(system, now, direction)
    return Series(system, now, direction, bending=tolerance)
