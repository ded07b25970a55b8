"""What a scene looks like: one signal, or one number over the sweep, of FMU and reference."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

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
class Overview:
    """Signals of a scene: `fmu` and `reference` at `times` (s), all shape (n,), n <= MAX_POINTS.

    Of a slow signal that is longer every so many points are kept, of a fast one the last.
    """

    scene: str
    quantity: str
    unit: str
    times: Array
    fmu: Array
    reference: Array


def overview_of(judged: Sequence[tuple[Check, Measurement, object]]) -> Overview | None:
    """Return the overview of a point from its checks, measurements and expected values.

    None where no expectation is a signal with a reference.
    """
    signals = {
        check.quantity: (check, measured, expected)
        for check, measured, expected in reversed(judged)
        if measured.times is not None
    }
    for name in (*SLOW, *FAST):
        if name not in signals:
            continue
        check, measured, expected = signals[name]
        reference = expected.middle if isinstance(expected, Tube) else expected
        if not isinstance(reference, np.ndarray) or measured.times is None:
            continue
        count = len(measured.times)
        if np.shape(measured.value) != (count,) or reference.shape != (count,):
            continue
        kept = _kept(count, fast=name in FAST)
        return Overview(
            *(check.scene, check.quantity, check.unit),
            *(measured.times[kept], measured.value[kept], reference[kept]),
        )
    return None


def _kept(count: int, *, fast: bool) -> NDArray[np.intp]:
    """Return the indices of the points to keep."""
    if count <= MAX_POINTS:
        return np.arange(count)
    if fast:
        return np.arange(count - MAX_POINTS, count)
    return np.unique(np.linspace(0, count - 1, MAX_POINTS).round().astype(int))
