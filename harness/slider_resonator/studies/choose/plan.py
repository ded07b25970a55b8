"""What a run asks of the FMU besides motion: steps, values that are set, and where these jump."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from slider_resonator.arrays import Array
from slider_resonator.device.schedule import Schedule

SAME = 1e-9
"""Share of a change of an input that counts as rounding."""


@dataclass(frozen=True)
class Plan:
    """The communication steps of a run, and how often values are set in it.

    `settings` are the points after the start at which values are set, twice as many where their
    derivatives are, too. `kicks` (s) are those at which a value jumps or the slope of a straight
    line changes; `led` (s) those at which phase, frequency ratio or a parameter do. `lines` tells
    whether straight lines are passed on, `turning` whether phase or ratio are among them.
    """

    duration: float
    steps: int
    settings: int
    kicks: Array
    led: Array
    lines: bool
    turning: bool


def plan_of(schedule: Schedule) -> Plan:
    """Return what a schedule asks."""
    times, sampled, rates = schedule.times, schedule.sampled(), schedule.rates()
    jumps = _jumps(times, sampled, rates)
    tuned = np.any(np.diff(schedule.tuned(), axis=0) != 0.0, axis=1)[:-1]
    led = jumps[:, 0] | jumps[:, 2] | tuned
    lines = schedule.ramps
    inside = times[1:-1]
    return Plan(
        duration=float(times[-1]),
        steps=len(times) - 1,
        settings=len(schedule.changes()) * (2 if lines else 1),
        kicks=inside[np.any(jumps, axis=1) | tuned],
        led=inside[led],
        lines=lines,
        turning=bool(np.any(rates[:, [0, 2]])),
    )


def _jumps(times: Array, sampled: Array, rates: Array) -> NDArray[np.bool_]:
    """Return whether each input jumps or changes its slope at the points inside, (n - 2, 3)."""
    lengths = np.diff(times)[:, None]
    expected = sampled[:-1] + rates[:-1] * lengths
    sizes = SAME * np.abs(sampled).max(axis=0)
    jumped = np.abs(sampled[1:] - expected)[:-1] > sizes
    bent = np.abs(np.diff(rates, axis=0))[:-1] > SAME * np.abs(rates).max(axis=0)
    return np.asarray(jumped | bent)
