"""Signals of FMU and reference for reports: those that differ, and one that shows a scene."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from slider_resonator.arrays import Array
from slider_resonator.checks.compare import Check
from slider_resonator.checks.measures import Tube
from slider_resonator.checks.measuring import Measurement

SLOW = ("mean_velocity_in_run", "slow_displacement", "position")
"""Signals that show a run, the first that a scene expects."""
FAST = ("velocity", "resonator_velocity", "resonator_displacement", "friction_force")
"""Signals of which the last points are shown where there is no slow one."""
MAX_POINTS = 400


@dataclass(frozen=True)
class Curves:
    """The signals behind a check: `fmu` and `reference` at `times` (s), all shape (n,)."""

    check: Check
    times: Array
    fmu: Array
    reference: Array

    def part(self, kept: slice | NDArray[np.intp]) -> "Curves":
        """Return some of the points, as copies."""
        signals = (self.times, self.fmu, self.reference)
        return Curves(self.check, *(np.array(signal[kept]) for signal in signals))

    def thinned(self) -> "Curves":
        """Return evenly spaced points, at most `MAX_POINTS`, and the one that is farthest off."""
        count = len(self.times)
        if count <= MAX_POINTS:
            return self
        even = np.linspace(0, count - 1, MAX_POINTS).round().astype(np.intp)
        off = np.nan_to_num(np.abs(self.fmu - self.reference), nan=np.inf)
        return self.part(np.union1d(even, np.argmax(off)))


def curves_of(check: Check, measured: Measurement, expected: Any) -> Curves | None:
    """Return the signals behind a check, None where it has none or no reference for it."""
    reference = expected.middle if isinstance(expected, Tube) else expected
    if measured.times is None or np.shape(reference) != np.shape(measured.value):
        return None
    return Curves(check, measured.times, measured.value, reference)


def overview_of(found: Sequence[Curves]) -> Curves | None:
    """Return the signal that shows a scene, thinned, or the end of a fast one; None without one."""
    by_quantity = {curves.check.quantity: curves for curves in reversed(found)}
    for name in (*SLOW, *FAST):
        if name in by_quantity:
            shown = by_quantity[name]
            return shown.part(slice(-MAX_POINTS, None)) if name in FAST else shown.thinned()
    return None
