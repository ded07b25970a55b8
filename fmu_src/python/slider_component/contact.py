"""When the contact lifts and touches down: N = max(0, N0 + dN sin(chi)) with dN > N0."""

from __future__ import annotations

from math import asin, inf, pi, sin, tau

from .plant import Plant

BACKWARD, STICK, FORWARD, LIFTED = -1, 0, 1, 2
"""Contact modes: the direction of sliding, rest, or flight."""

REACHED = 1e-12
"""Distance [rad] from a boundary within which it counts as reached: rounding. The shortest flight
that floating point numbers can describe is 3e-8 rad long."""


def flight_window(plant: Plant) -> tuple[float, float] | None:
    """Range of chi [rad] in which the contact is lifted; None if it never is.

    It is [0, 2 pi] if there is no normal load at all.
    """
    if plant.preload_share >= 1.0:
        return None
    if plant.preload_share < 0.0:
        return 0.0, tau
    dip = asin(plant.preload_share)
    return pi + dip, tau - dip


def is_lifted(window: tuple[float, float] | None, chi: float, frequency: float) -> bool:
    """Whether the contact is lifted at normal phase `chi` [rad].

    On a boundary this depends on the direction in which the phase moves: `frequency` [rad/s] is its
    rate. At rate 0 the contact is lifted where the normal load is 0.
    """
    if window is None:
        return False
    width = window[1] - window[0]
    if width >= tau:
        return True
    inside = (chi - window[0]) % tau
    if tau - inside < REACHED:
        inside -= tau
    if frequency > 0.0:
        return -REACHED < inside < width - REACHED
    if frequency < 0.0:
        return REACHED < inside < width + REACHED
    return -REACHED < inside < width + REACHED


def time_to_switch(
    window: tuple[float, float] | None, chi: float, frequency: float, lifted: bool
) -> float:
    """Time [s] until the contact lifts, or touches down when `lifted`; infinite if never.

    `frequency` [rad/s] is that of the normal load and may be negative.
    """
    if window is None or frequency == 0.0 or window[1] - window[0] >= tau:
        return inf
    first, last = window if frequency > 0.0 else (window[1], window[0])
    ahead = (last if lifted else first) - chi
    ahead = (ahead if frequency > 0.0 else -ahead) % tau
    return 0.0 if tau - ahead < REACHED else ahead / abs(frequency)


def direction_of(velocity: float) -> int:
    """BACKWARD, FORWARD, or STICK at rest."""
    return (velocity > 0.0) - (velocity < 0.0)


def friction_limit(plant: Plant, psi: float) -> float:
    """Friction force [N] of all faces at normal phase `psi` [rad] when sliding; 0 in flight."""
    limit = plant.friction_preload + plant.friction_amplitude * sin(psi + plant.phase)
    return limit if limit > 0.0 else 0.0
