"""The units in which curves are drawn: the same for a single run and for several."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from slider_resonator.arrays import Array

_LADDERS: Mapping[str, Sequence[tuple[float, float, str]]] = {
    "m": ((1e-4, 1e6, "um"), (2.0, 1e3, "mm")),
    "m/s": ((2.0, 1e3, "mm/s"),),
    "s": ((2.0, 1e3, "ms"),),
}
"""For a unit, the peaks below which another unit suits curves, with the factor to it."""


def plot_unit(unit: str, *curves: Array) -> tuple[float, str]:
    """Return the factor from `unit` to the unit that suits the peak of these curves, and that unit.

    Each curve has shape (n,); all share the unit, so that they can be compared in one panel.
    """
    peak = max((float(np.abs(curve).max()) for curve in curves if curve.size), default=0.0)
    for limit, factor, smaller in _LADDERS.get(unit, ()):
        if peak < limit:
            return factor, smaller
    return 1.0, unit
