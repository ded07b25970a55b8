"""Contact modes of a rigid Coulomb slider, and the instants at which its contact lifts."""

import math

SLIP_BACKWARD = -1
STICK = 0
SLIP_FORWARD = 1
LIFTED = 2

_TURN = 2.0 * math.pi


def time_to_contact_change(
    lifted: bool,
    preload: float,
    amplitude: float,
    angle: float,
    rate: float,
    acceleration: float = 0.0,
) -> float:
    """Return the time in s until ``preload + amplitude sin(angle + rate t)`` crosses zero.

    That is upward, the touchdown, of a ``lifted`` contact and downward, the lift-off, of a closed
    one. Infinite if it never does. A contact that only touches zero does not lift. The angle
    may have an ``acceleration`` (rad/s^2), as long as its rate keeps the sign; one of 0 takes that
    of the acceleration.
    """
    going = rate or acceleration
    if amplitude <= preload or going == 0.0:
        return math.inf
    half_flight = math.copysign(math.acos(preload / amplitude), going)
    target = 1.5 * math.pi + (half_flight if lifted else -half_flight)
    way = math.copysign(1.0, going) * (target - angle) % _TURN
    if acceleration == 0.0:
        return way / abs(rate)
    square = rate * rate + 2.0 * math.copysign(1.0, going) * acceleration * way
    return 2.0 * way / (abs(rate) + math.sqrt(square)) if square >= 0.0 else math.inf


def is_lifted(preload: float, amplitude: float, angle: float, rate: float) -> bool:
    """Return whether the contact is open just after the normal load has the given angle (rad)."""
    if rate == 0.0 or amplitude == 0.0:
        return preload + amplitude * math.sin(angle) <= 0.0
    # The order of the next two crossings decides, not the sign of the normal load: at a crossing
    # that sign is rounding, and a decision against the crossing times would lose a whole flight.
    # The order is that of the angles, whatever changes the rate before either comes.
    touchdown, lift_off = (
        time_to_contact_change(lifted, preload, amplitude, angle, rate) for lifted in (True, False)
    )
    return lift_off == 0.0 or 0.0 < touchdown < lift_off
