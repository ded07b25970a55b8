"""Dormand and Prince's 5(4) pair for one velocity and the displacement, its integral."""

from __future__ import annotations

from collections.abc import Callable
from math import inf, isfinite
from typing import NamedTuple


class Reached(NamedTuple):
    """Where an integration is.

    Time [s], velocity [m/s], displacement [m], the step size to try next [s], and the number of
    steps `tried`.
    """

    t: float
    velocity: float
    moved: float
    step: float
    tried: int = 0


class _Stage(NamedTuple):
    """A step tried.

    `change` of the velocity and its estimated `error` [m/s], displacement `moved` [m], and the
    acceleration `last` at the end [m/s^2].
    """

    change: float
    moved: float
    error: float
    last: float


def integrate(
    acceleration: Callable[[float, float], float],
    now: Reached,
    end: float,
    tolerance: float,
    max_steps: int,
    longest: float = inf,
) -> Reached:
    """Integrate to time `end` [s], or for `max_steps` accepted and rejected steps.

    `acceleration(t, v)` is in m/s^2; `tolerance` [m/s] is the error allowed in a step. `longest`
    [s] bounds the step size: over the period of a periodic acceleration all stages would see the
    same value.
    """
    t, velocity, displacement, step, tried = now
    first = acceleration(t, velocity)
    for _ in range(max_steps):
        if not t < end or not isfinite(velocity):
            break
        left = end - t
        tried += 1
        h = min(step, longest, left)
        stage = _try_step(acceleration, t, velocity, h, first)
        if not stage.error > tolerance:
            displacement += stage.moved
            velocity, first = velocity + stage.change, stage.last
            t = t + h if h < left else end
        growth = 0.9 * (tolerance / stage.error) ** 0.2 if stage.error > 0.0 else 5.0
        step = h * min(5.0, max(0.2, growth))
    return Reached(t, velocity, displacement, step, tried)


def _try_step(
    acceleration: Callable[[float, float], float], t: float, v: float, h: float, k1: float
) -> _Stage:
    k2 = acceleration(t + h / 5, v + h * k1 / 5)
    k3 = acceleration(t + 3 * h / 10, v + h * (3 * k1 + 9 * k2) / 40)
    k4 = acceleration(t + 4 * h / 5, v + h * (44 * k1 / 45 - 56 * k2 / 15 + 32 * k3 / 9))
    by_k5 = 19372 * k1 / 6561 - 25360 * k2 / 2187 + 64448 * k3 / 6561 - 212 * k4 / 729
    k5 = acceleration(t + 8 * h / 9, v + h * by_k5)
    by_k6 = 9017 * k1 / 3168 - 355 * k2 / 33 + 46732 * k3 / 5247 + 49 * k4 / 176 - 5103 * k5 / 18656
    k6 = acceleration(t + h, v + h * by_k6)
    change = h * (
        35 * k1 / 384 + 500 * k3 / 1113 + 125 * k4 / 192 - 2187 * k5 / 6784 + 11 * k6 / 84
    )
    last = acceleration(t + h, v + change)
    by_error = 71 * k1 / 57600 - 71 * k3 / 16695 + 71 * k4 / 1920 - 17253 * k5 / 339200
    error = h * abs(by_error + 22 * k6 / 525 - last / 40)
    # The weights of the fifth order, applied to the velocities at the stages.
    moved = h * v + h * h * (35 * k1 / 384 + 50 * k3 / 159 + 25 * k4 / 192 - 243 * k5 / 6784)
    return _Stage(change, moved, error, last)
