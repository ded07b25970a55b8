"""The units in which curves are drawn: the same for a single run and for several."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import inf, pi

import numpy as np

from slider_resonator.arrays import Array

_LADDERS: Mapping[str, Sequence[tuple[float, float, str]]] = {
    "m": ((1e-4, 1e6, "um"), (2.0, 1e3, "mm")),
    "m/s": ((2.0, 1e3, "mm/s"),),
    "s": ((2.0, 1e3, "ms"),),
    "N": ((0.5, 1e3, "mN"),),
    "W": ((0.5, 1e3, "mW"),),
    "kg": ((0.5, 1e3, "g"),),
    "rad": ((inf, 180.0 / pi, "deg"),),
    "rad/s": ((2e4 * pi, 0.5 / pi, "Hz"), (inf, 5e-4 / pi, "kHz")),
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


@dataclass(frozen=True)
class Drawn:
    """A quantity as it is drawn: `values` (n,) in `unit`, NaN where there is none."""

    words: str
    unit: str
    values: Array

    @property
    def label(self) -> str:
        """The label of an axis."""
        return f"{self.words} [{self.unit}]"

    def named(self, value: float) -> str:
        """Return the name of a line of one value in `unit`."""
        return f"{self.words} {value:.4g} {self.unit}".removesuffix(" 1")


def drawn(name: str, unit: str, values: Array) -> Drawn:
    """Return a quantity of this name, whose values (n,) are in `unit`, as it is drawn."""
    factor, suited = plot_unit(unit, values[np.isfinite(values)])
    return Drawn(name.replace("_", " "), suited, factor * values)
