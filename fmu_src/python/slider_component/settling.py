"""The last approach of averaged motion to a steady velocity, in closed form."""

from __future__ import annotations

from collections.abc import Callable

from .dormand_prince import Reached

NEAR = 1e-7
"""Distance from balance, in fast velocities, at which motion settles: well above the error of the
steps before, and so short that forces are linear over it."""

SETTLED = 20.0
"""Number of time constants of the approach that the time left must exceed."""

MAX_SECANTS = 40

Acceleration = Callable[[float, float], float]


def settled(acceleration: Acceleration, fast: float, end: float, now: Reached) -> Reached | None:
    """The state at time `end` [s] if the velocity reaches a balance of forces before.

    None unless the velocity is already close to that balance, relative to the `fast` velocity
    [m/s]. `acceleration(t, v)` [m/s^2] must not depend on time.
    """
    low, high = now.velocity - NEAR * fast, now.velocity + NEAR * fast
    left = end - now.t
    at_low, at_high = acceleration(0.0, low), acceleration(0.0, high)
    if not at_low > 0.0 > at_high:
        return None
    rate = (at_low - at_high) / (high - low)
    if not rate * left > SETTLED:
        return None
    balance = _balance_between(acceleration, low, at_low, high, at_high)
    moved = now.moved + (balance * left + (now.velocity - balance) / rate)
    return now._replace(t=end, velocity=balance, moved=moved)


def is_settled(acceleration: Acceleration, fast: float, noise: float, now: Reached) -> bool:
    """Whether forces balance now and draw the velocity back to where it is.

    `acceleration(t, v)` [m/s^2] must not depend on time: it is `noise`, its rounding error.
    """
    beside = NEAR * fast
    return (
        abs(acceleration(now.t, now.velocity)) <= noise
        and acceleration(now.t, now.velocity - beside) > 0.0
        and acceleration(now.t, now.velocity + beside) < 0.0
    )


def _balance_between(
    acceleration: Acceleration, low: float, at_low: float, high: float, at_high: float
) -> float:
    """The velocity between `low` and `high` [m/s] at which the acceleration falls through 0.

    Regula falsi with the Illinois rule, which halves the weight of an end that stays.
    """
    root, side = low, 0
    for _ in range(MAX_SECANTS):
        before, root = root, low + (high - low) * (at_low / (at_low - at_high))
        at_root = acceleration(0.0, root)
        if at_root == 0.0 or root == before or not low < root < high:
            break
        if at_root > 0.0:
            low, at_low = root, at_root
            at_high *= 0.5 if side > 0 else 1.0
            side = 1
        else:
            high, at_high = root, at_root
            at_low *= 0.5 if side < 0 else 1.0
            side = -1
    return root
