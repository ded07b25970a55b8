"""The deviation of one sampled signal from another."""

from __future__ import annotations

import numpy as np

from slider_resonator.arrays import Array


def peak(signal: Array) -> float:
    """Return the largest magnitude of a signal (n,), NaN when there is one in it."""
    return float(np.abs(signal).max())


def share_of(difference: float, size: float) -> float:
    """Return a difference as a share of a size: 0 of nothing is 0, anything else is infinite."""
    if difference == 0.0:
        return 0.0
    return difference / size if size > 0.0 else float("inf")


def mismatch_share(error: Array) -> float:
    """Return the share of points at which two signals of integers differ, from the error (n,).

    An error that is not finite counts as a difference.
    """
    return float(np.mean(~(error <= 0.5)))
