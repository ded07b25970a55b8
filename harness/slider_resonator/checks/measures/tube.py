"""Bounds around a reference signal."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from slider_resonator.arrays import Array


@dataclass(frozen=True)
class Tube:
    """A reference signal `middle` and its `lower` and `upper` bounds, all shape (n,)."""

    middle: Array
    lower: Array
    upper: Array

    def outside(self, signal: Array) -> Array:
        """Return the distance of a signal (n,) from the tube at each point, NaN where it is NaN."""
        return np.maximum(0.0, np.maximum(self.lower - signal, signal - self.upper))


def no_tube(reference: Array) -> Tube:
    """Return a tube of width 0 around a signal (n,)."""
    return Tube(reference, reference, reference)
