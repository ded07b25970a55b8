"""The ripple: the oscillation of a position at the drive frequency."""

from __future__ import annotations

import numpy as np

from slider_resonator.arrays import Array

POINTS_PER_PERIOD = 8
PERIODS = 4
"""The last drive periods of a record, to which the ripple is fitted."""


def ripple_amplitude(times: Array, position: Array, period: float) -> float:
    """Return the amplitude of the component at the drive frequency, in the unit of the position.

    It is fitted, together with a straight line, to the last `PERIODS` drive periods of the record,
    `period` (s) each. Raises ValueError for a record that is shorter or has fewer than 8 points per
    period.
    """
    window = times >= times[-1] - PERIODS * period * (1.0 + 1e-9)
    if times[-1] - times[0] < PERIODS * period * (1.0 - 1e-9):
        raise ValueError(f"the ripple needs a record of at least {PERIODS} drive periods")
    if window.sum() < PERIODS * POINTS_PER_PERIOD:
        raise ValueError(
            f"the ripple needs at least {POINTS_PER_PERIOD} points per drive period, "
            f"the record has {window.sum() / PERIODS:.1f}"
        )
    time = (times[window] - times[-1]) / period
    angle = 2.0 * np.pi * time
    basis = np.column_stack([np.ones_like(time), time, np.cos(angle), np.sin(angle)])
    coefficients = np.linalg.lstsq(basis, position[window], rcond=None)[0]
    return float(np.hypot(coefficients[2], coefficients[3]))
