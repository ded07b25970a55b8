"""Bounds around a reference signal, as wide in time as a share of the drive period allows."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Tube:
    """A reference signal `middle` and its `lower` and `upper` bounds, all shape (n,)."""

    middle: Array
    lower: Array
    upper: Array

    def outside(self, signal: Array) -> Array:
        """Return how far a signal (n,) is outside at each point, NaN where it is NaN."""
        return np.maximum(0.0, np.maximum(self.lower - signal, signal - self.upper))


def no_tube(reference: Array) -> Tube:
    """Return the tube of no width around a signal (n,)."""
    return Tube(reference, reference, reference)
