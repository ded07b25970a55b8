"""What a run asks of the FMU besides motion: steps, values that are set, and where these jump."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from slider_resonator.arrays import Array
from slider_resonator.choosing.scales import NEAR_AN_INTEGER
from slider_resonator.device.schedule import Schedule

SAME = 1e-9
"""Share of a change of an input that counts as rounding."""
DRIVING = ("base_amplitude", "drive_frequency", "tangential_force")
"""Tuned parameters that shake the resonator."""
MAX_TURNS = 3
"""Largest number of turns of the drive after which the phase is looked at."""


@dataclass(frozen=True)
class Plan:
    """The communication steps of a run of `duration` (s), and how often values are set in it.

    `settings` are the points after the start at which values are set, twice as many where their
    derivatives are, too. `kicks` are those at which a value jumps or a straight line that is passed
    on changes its slope, `tunings` those of parameters among them, and `shakes` those that shake
    the resonator. `beats` are the turns of the slow phase by the frequency ratio. `ramped` are the
    drive periods in which an input grows along a line, `chirped` those in which the frequency ratio
    does.
    """

    duration: float
    steps: int
    settings: int = 0
    kicks: int = 0
    tunings: int = 0
    shakes: int = 0
    beats: float = 0.0
    ramped: float = 0.0
    chirped: float = 0.0


def plan_of(schedule: Schedule, period: float) -> Plan:
    """Return what a schedule asks; `period` (s) is the drive's."""
    times, sampled, rates = schedule.times, schedule.sampled(), schedule.rates()
    tuned = np.diff(schedule.tuned(), axis=0)[:-1] != 0.0
    driving = np.array([name in DRIVING for name in schedule.tuning], dtype=bool)
    kicked = np.any(_changes(times, sampled, rates), axis=1)
    lengths = np.diff(times) / period
    chirps = rates[:-1, 2] != 0.0
    detuning = _detuning(sampled[:-1, 2] + 0.5 * rates[:-1, 2] * np.diff(times))
    return Plan(
        duration=float(times[-1]),
        steps=len(times) - 1,
        settings=len(schedule.changes()) * (2 if schedule.ramps else 1),
        kicks=int(np.count_nonzero(kicked | np.any(tuned, axis=1))),
        tunings=int(np.count_nonzero(np.any(tuned, axis=1))),
        shakes=int(np.count_nonzero(np.any(tuned[:, driving], axis=1))),
        beats=float((np.where(detuning < NEAR_AN_INTEGER, detuning, 0.0) * lengths).sum()),
        ramped=float(lengths[np.any(rates[:-1] != 0.0, axis=1)].sum()),
        chirped=float(lengths[chirps].sum()),
    )


def _detuning(ratios: Array) -> Array:
    """Return the distance (n,) from the nearest ratio at which the phase stands still."""
    ways = [np.abs(turns * ratios - np.round(turns * ratios)) for turns in range(1, MAX_TURNS + 1)]
    return np.asarray(np.min(ways, axis=0))


def _changes(times: Array, sampled: Array, rates: Array) -> NDArray[np.bool_]:
    """Return where each input or its slope jumps: at points inside, shape (n - 2, 3)."""
    lengths = np.diff(times)[:, None]
    expected = sampled[:-1] + rates[:-1] * lengths
    sizes = SAME * np.abs(sampled).max(axis=0)
    jumped = np.abs(sampled[1:] - expected)[:-1] > sizes
    bent = np.abs(np.diff(rates, axis=0))[:-1] > SAME * np.abs(rates).max(axis=0)
    return np.asarray(jumped | bent)
