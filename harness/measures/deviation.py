"""How far two sampled signals are apart."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def peak(signal: NDArray[np.float64]) -> float:
    """Return the largest magnitude of a signal (n,)."""
    return float(np.abs(signal).max())


def peak_deviation(
    signal: NDArray[np.float64], reference: NDArray[np.float64], floor: float = 0.0
) -> float:
    """Return the largest difference of two signals (n,) as a share of the reference's peak.

    `floor`, in the signals' unit, is added to the peak, for references near zero. Two signals that
    are zero throughout agree; without a floor any other signal deviates infinitely from zero.
    """
    difference, size = peak(signal - reference), peak(reference) + floor
    if difference == 0.0:
        return 0.0
    return difference / size if size > 0.0 else float("inf")


def mismatch_share(
    signal: NDArray[np.float64], reference: NDArray[np.float64], floor: float = 0.0
) -> float:
    """Return the share of points at which two signals of whole numbers (n,) differ by over `floor`.

    What is not finite differs.
    """
    return float(np.mean(~(np.abs(np.rint(signal) - np.rint(reference)) <= floor)))
