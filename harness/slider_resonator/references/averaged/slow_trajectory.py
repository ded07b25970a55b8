"""The trajectory of a slow motion, from its averaged acceleration."""

from __future__ import annotations

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
