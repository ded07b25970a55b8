"""Trajectories of slow motion: from an averaged acceleration, and of a block without vibration."""

import math
from collections.abc import Callable

import numpy as np
import scipy

from slider_resonator.arrays import Array


def slow_trajectory(
    acceleration: Callable[[float, float], float],
    times: Array,
    velocity: float = 0.0,
    max_step: float = np.inf,
) -> tuple[Array, Array]:
    """Return slow position and velocity at ``times`` (n,), from position 0 at the first of them.

    ``acceleration`` is a function of time and velocity; where it depends on time, steps of at most
    ``max_step`` resolve it. Raises RuntimeError when it cannot be integrated.
    """

    def rates(time: float, state: Array) -> tuple[float, float]:
        slow = float(state[1])  # scalars of numpy take several times as long
        return slow, acceleration(float(time), slow)

    solution = scipy.integrate.solve_ivp(
        rates,
        (times[0], times[-1]),
        (0.0, velocity),
        method="DOP853" if np.isfinite(max_step) else "LSODA",
        t_eval=times,
        rtol=1e-11,
        atol=1e-12,
        max_step=max_step,
    )
    if not solution.success:
        raise RuntimeError(f"the slow motion cannot be integrated: {solution.message}")
    return np.asarray(solution.y[0]), np.asarray(solution.y[1])


def slide_of_block(
    velocity: float, friction: float, load: float, mass: float, times: Array
) -> tuple[Array, Array]:
    """Return how far a block has moved (m) and its velocity (m/s) at ``times``, shape (n,), s.

    Dry friction of constant size acts against a constant load. ``velocity`` (m/s) is that at time
    0; ``friction`` (N) holds a block at rest against a smaller ``load`` (N), which pulls backward;
    ``mass`` is in kg.
    """
    deceleration = (math.copysign(friction, velocity) + load) / mass if velocity else 0.0
    stops = math.inf if velocity else 0.0
    if deceleration * velocity > 0.0:
        stops = velocity / deceleration
    first = np.minimum(times, stops)
    moved = velocity * first - 0.5 * deceleration * first**2
    speed = np.where(times < stops, velocity - deceleration * first, 0.0)
    if abs(load) > friction:
        dragged = -math.copysign(abs(load) - friction, load) / mass
        rest = np.maximum(times - stops, 0.0)
        moved += 0.5 * dragged * rest**2
        speed += dragged * rest
    return moved, speed
