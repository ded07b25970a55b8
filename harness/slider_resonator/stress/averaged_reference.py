"""Compare averaged motion of first order with a reference that computes the means differently."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.averaged.averaged_motion import simulate_averaged
from slider_resonator.references.closed_forms import equivalent_force
from slider_resonator.stress.case import MIN_DIVISIBLE, MatrixCell
from slider_resonator.stress.observe import Observation
from slider_resonator.stress.verdict import REFERENCE, BoundCheck

REFERENCE_ERROR = 1e-6
"""Error of the reference, as a fraction of peaks; each of its steps keeps 1e-8."""
MAX_RELAXATIONS = 5000.0
"""Longest run with LuGre friction, in times that friction takes to stop the fast velocity: beyond,
the quadratures of the reference in stiff steps take longer than all other cells together."""


def covers(cell: MatrixCell) -> bool:
    """Return whether the reference covers a cell of averaged motion at an acceptable cost.

    It needs friction under a mean load, and a vibration.
    """
    device = cell.device
    friction = device.friction_faces * device.friction_coefficient * device.normal_preload
    if cell.start_time or not friction > 0.0 or min(h.size for h in cell.holds) <= MIN_DIVISIBLE:
        return False
    try:
        fast = equivalent_force(device).velocity_amplitude
    except (ValueError, OverflowError):  # undamped resonance, or values beyond all numbers
        return False
    duration = sum(hold.size * hold.count for hold in cell.holds)
    lasting = MAX_RELAXATIONS * device.total_mass * fast / friction
    return fast > 0.0 and (device.friction_law == 0 or duration <= lasting)


def compare(
    cell: MatrixCell,
    seen: Observation,
    held: Sequence[HeldInputs],
    times: NDArray[np.float64],
    own: float,
) -> BoundCheck:
    """Return the check of mean velocity and position; `own` is the error allowed to the FMU.

    Raises what the reference does: RuntimeError, ValueError.
    """
    device = cell.device
    fast = equivalent_force(device).velocity_amplitude
    motion = simulate_averaged(device, held, times)
    worst, words = 0.0, ""
    for name, floor in (("mean_velocity", fast), ("position", fast / device.drive_frequency)):
        # Before the first step there is no mean over a period.
        there, here = getattr(motion, name)[1:], seen.signal(name)[1:]
        off, size = float(np.abs(here - there).max()), max(float(np.abs(there).max()), floor)
        found = off / (size * (REFERENCE_ERROR + own))
        if not found <= worst:
            worst, words = found, f"{name} off by {off:.3g}, {off / size:.3g} of its peak"
    return BoundCheck(REFERENCE, worst, words)
