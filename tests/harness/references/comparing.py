"""Comparing trajectories, and splitting the inputs of a run."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np

from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.resolved.trajectory import Trajectory
from tests.problems import SIGNALS


def until(stop: float, **inputs: float) -> list[HeldInputs]:
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
    counts = [(run.reversals, run.sticks) for run in (expected, found)]
    assert counts[0] == counts[1], "reversals and sticks"


def split(held: Sequence[HeldInputs], count: int) -> list[HeldInputs]:
    """Return the same inputs, cut at `count` - 1 uneven times of the whole span."""
    cuts = np.sqrt(np.arange(1.0, count) / count) * held[-1].stop
    pieces: list[HeldInputs] = []
    for inputs in held:
        within = cuts[(cuts > inputs.start) & (cuts < inputs.stop)]
        edges = [inputs.start, *within.tolist(), inputs.stop]
        pieces += [replace(inputs, start=start, stop=stop) for start, stop in pairwise(edges)]
    return pieces
