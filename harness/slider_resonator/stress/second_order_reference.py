"""Compare motion that leaps over periods with the resolved motion of the full device."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.checks.leap_error import allowed_by_leaps, centre_signals
from slider_resonator.device.device import FULL, Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.stress.case import MatrixCell
from slider_resonator.stress.observe import Observation
from slider_resonator.stress.verdict import REFERENCE, BoundCheck


def full_device(cell: MatrixCell) -> Device:
    """Return the device whose resolved motion a cell is compared with."""
    return replace(cell.device, fidelity=FULL)


def compare(
    cell: MatrixCell,
    seen: Observation,
    held: Sequence[HeldInputs],
    motion: Mapping[str, Array],
    own: float,
) -> BoundCheck:
    """Return the check of slider and resonator as one mass; `motion` is that of the full device.

    `own` is the error allowed of a resolved motion, as a fraction of peaks.
    """
    device = cell.device
    allowed = allowed_by_leaps(device, held, float(seen.sizes.sum()))
    signals = {name: seen.signal(name) for name in motion}
    here, there = centre_signals(device, signals), centre_signals(device, motion)
    worst, words = 0.0, ""
    for name, bound in allowed.items():
        off = float(np.abs(here[name] - there[name]).max())
        total = bound + own * float(np.abs(there[name]).max())
        found = off / total if total else 2.0 * float(off > 0.0)
        if not found <= worst:
            worst, words = found, f"{name} off by {off:.3g}, allowed {total:.3g}"
    return BoundCheck(REFERENCE, worst, words)
