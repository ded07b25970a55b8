"""Dormand and Prince's 5(4) pair for one velocity and the position that it sums up to."""

from __future__ import annotations

from collections.abc import Callable

from .refusal import Refusal

MOST_STEPS = 100_000
"""Accepted and rejected steps within one call: bounds the work."""


def integrate(
    acceleration: Callable[[float, float], float],
    velocity: float,
    duration: float,
    step: float,
    tolerance: float,
) -> tuple[float, float]:
    """Velocity [m/s] after `duration` [s] and the displacement [m] on the way.

    `acceleration(t, v)` [m/s^2]; `step` [s] is tried first and `tolerance` [m/s] allowed per step.
    Raises Refusal after MOST_STEPS steps.
    """
    t = displacement = 0.0
    first = acceleration(0.0, velocity)
    for _ in range(MOST_STEPS):
        step = min(step, duration - t)
        v, h = velocity, step
        k1 = first
        k2 = acceleration(t + h / 5, v + h * k1 / 5)
        k3 = acceleration(t + 3 * h / 10, v + h * (3 * k1 + 9 * k2) / 40)
        k4 = acceleration(t + 4 * h / 5, v + h * (44 * k1 / 45 - 56 * k2 / 15 + 32 * k3 / 9))
        k5 = acceleration(
            t + 8 * h / 9,
            v + h * (19372 * k1 / 6561 - 25360 * k2 / 2187 + 64448 * k3 / 6561 - 212 * k4 / 729),
        )
        k6 = acceleration(
            t + h,
            v
            + h
            * (
                9017 * k1 / 3168
                - 355 * k2 / 33
                + 46732 * k3 / 5247
                + 49 * k4 / 176
                - 5103 * k5 / 18656
            ),
        )
        change = h * (
            35 * k1 / 384 + 500 * k3 / 1113 + 125 * k4 / 192 - 2187 * k5 / 6784 + 11 * k6 / 84
        )
        k7 = acceleration(t + h, v + change)
        error = h * abs(
            71 * k1 / 57600
            - 71 * k3 / 16695
            + 71 * k4 / 1920
            - 17253 * k5 / 339200
            + 22 * k6 / 525
            - k7 / 40
        )
        if error <= tolerance:
            # The weights of the pair, applied to the velocities at its stages.
            displacement += h * v + h * h * (
                35 * k1 / 384 + 50 * k3 / 159 + 25 * k4 / 192 - 243 * k5 / 6784
            )
            velocity, t, first = v + change, t + h, k7
            if t >= duration:
                return velocity, displacement
        growth = 0.9 * (tolerance / error) ** 0.2 if error > 0.0 else 5.0
        step = h * min(5.0, max(0.2, growth))
    raise Refusal(
        f"doStep refused: averaged motion needs more than {MOST_STEPS} steps of its own; allowed "
        "is a shorter communication step or a stronger vibration, or fidelity 1 or 2"
    )
