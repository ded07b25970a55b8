"""Comparing trajectories, and inputs of a run."""

from typing import Any

import numpy as np

from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.resolved.contact import STICK
from slider_resonator.references.resolved.trajectory import Trajectory
from tests.problems import SIGNALS


def until(stop: float, **inputs: Any) -> list[HeldInputs]:
    """Constant inputs from 0 to `stop`, s."""
    return [HeldInputs(0.0, stop, **inputs)]


def deviation(expected: Trajectory, found: Trajectory, signal: str) -> float:
    """Greatest deviation of a signal, in fractions of its peak."""
    reference = getattr(expected, signal)
    error, peak = np.abs(getattr(found, signal) - reference).max(), np.abs(reference).max()
    return float(error / peak) if error else 0.0


def assert_agree(expected: Trajectory, found: Trajectory, allowed: float) -> None:
    """Require equal counts, and signals within a fraction of their peaks."""
    for signal in (*SIGNALS, "bristle_deflection"):
        off = deviation(expected, found, signal)
        assert off <= allowed, f"{signal} deviates by {off:.1e} of its peak"
    counts = [(run.reversal_times.size, sum(run.modes == STICK)) for run in (expected, found)]
    assert counts[0] == counts[1], "reversals and sticks"
