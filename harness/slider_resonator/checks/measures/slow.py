"""The slow displacement: a position without its ripple."""

from __future__ import annotations

import numpy as np
import scipy

from slider_resonator.arrays import Array


def slow_displacement(times: Array, position: Array, period: float) -> Array:
    """Return the position averaged over the drive period (s) that ends at each time, shape (m,).

    The m results belong to the times from the end of the first period on. With equal steps that
    divide the period the ripple vanishes from it exactly. Raises ValueError for a record shorter
    than a period.
    """
    starts = times - period
    first = int(np.searchsorted(starts, times[0] - 1e-9 * period))
    if first == len(times):
        raise ValueError(
            f"a record of {times[-1] - times[0]:.6g} s is shorter than the period {period:.6g} s"
        )
    integral = scipy.integrate.cumulative_trapezoid(position, times, initial=0)
    return np.asarray((integral[first:] - np.interp(starts[first:], times, integral)) / period)


def last_step_velocity(times: Array, position: Array) -> float:
    """Return the travel over the last step of a run by its time, m/s."""
    return float((position[-1] - position[-2]) / (times[-1] - times[-2]))
