"""What a run asks of the FMU besides motion: steps, values that are set, and where these jump."""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil, tau

import numpy as np
from numpy.typing import NDArray

from slider_resonator.arrays import Array
from slider_resonator.device.schedule import Schedule
from slider_resonator.studies.choose.scales import NEAR_AN_INTEGER

SAME = 1e-9
"""Share of a change of an input that counts as rounding."""
DRIVING = ("base_amplitude", "drive_frequency", "tangential_force")
"""Tuned parameters that shake the resonator."""
MAX_TURNS = 3
"""Largest number of turns of the drive after which the phase is looked at."""
MAX_STAYS = 2000
"""Largest number of stays that are distinguished; of more, several count as one."""


@dataclass(frozen=True)
class Stay:
    """Motion under one lead, or one that drifts: `periods` of the drive that begin with a change.

    `lead` is the same where the orbits are, up to rounding. `tuned` says whether the change is that
    of a parameter, `driven` whether it shakes the resonator, `bends` whether it is that of a slope
    alone. `beats` are the turns of the slow phase by the frequency ratio, and `count` is how many
    changes it is.
    """

    periods: float
    lead: tuple[float, float]
    drifts: bool
    tuned: bool = False
    driven: bool = False
    bends: bool = False
    beats: float = 0.0
    count: int = 1

    @property
    def goes_on(self) -> bool:
        """Whether the lead goes on drifting, along a line of another slope."""
        return self.bends and self.drifts


@dataclass(frozen=True)
class Plan:
    """The communication steps of a run of `duration` (s), and how often values are set in it.

    `settings` are the points after the start at which values are set, twice as many where their
    derivatives are, too. `kicks` are those at which a value jumps or a straight line that is passed
    on changes its slope, and `stays` what lies between those of phase, ratio and parameters.
    `ramped` are the drive periods in which an input grows along a line, `chirped` those in which
    the frequency ratio does.
    """

    duration: float
    steps: int
    settings: int = 0
    kicks: int = 0
    stays: tuple[Stay, ...] = ()
    ramped: float = 0.0
    chirped: float = 0.0

    @property
    def beats(self) -> float:
        """Turns of the slow phase by the frequency ratio."""
        return sum(stay.beats for stay in self.stays)

    @property
    def tunings(self) -> int:
        """Changes of parameters."""
        return sum(stay.count for stay in self.stays if stay.tuned)

    @property
    def shakes(self) -> int:
        """Changes that shake the resonator."""
        return sum(stay.count for stay in self.stays if stay.driven)


def plan_of(schedule: Schedule, period: float) -> Plan:
    """Return what a schedule asks; `period` (s) is the drive's."""
    times, sampled, rates = schedule.times, schedule.sampled(), schedule.rates()
    tuned = np.diff(schedule.tuned(), axis=0)[:-1] != 0.0
    jumped, bent = _changes(times, sampled, rates)
    lengths = np.diff(times) / period
    chirps = rates[:-1, 2] != 0.0
    detuning = _detuning(sampled[:-1, 2] + 0.5 * rates[:-1, 2] * np.diff(times))
    return Plan(
        duration=float(times[-1]),
        steps=len(times) - 1,
        settings=len(schedule.changes()) * (2 if schedule.ramps else 1),
        kicks=int(np.count_nonzero(np.any(jumped | bent, axis=1) | np.any(tuned, axis=1))),
        stays=_stays(schedule, jumped, bent, tuned, lengths, detuning),
        ramped=float(lengths[np.any(rates[:-1] != 0.0, axis=1)].sum()),
        chirped=float(lengths[chirps].sum()),
    )


def _detuning(ratios: Array) -> Array:
    """Return the distance (n,) from the nearest ratio at which the phase stands still."""
    ways = [np.abs(turns * ratios - np.round(turns * ratios)) for turns in range(1, MAX_TURNS + 1)]
    return np.asarray(np.min(ways, axis=0))


def _changes(
    times: Array, sampled: Array, rates: Array
) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """Return where each input jumps, and where its slope does: at points inside, (n - 2, 3)."""
    lengths = np.diff(times)[:, None]
    expected = sampled[:-1] + rates[:-1] * lengths
    sizes = SAME * np.abs(sampled).max(axis=0)
    jumped = np.abs(sampled[1:] - expected)[:-1] > sizes
    bent = np.abs(np.diff(rates, axis=0))[:-1] > SAME * np.abs(rates).max(axis=0)
    return np.asarray(jumped), np.asarray(bent)


def _stays(
    schedule: Schedule,
    jumped: NDArray[np.bool_],
    bent: NDArray[np.bool_],
    tuned: NDArray[np.bool_],
    lengths: Array,
    detuning: Array,
) -> tuple[Stay, ...]:
    """Return the stays from the changes of inputs (n - 2, 3) and of parameters (n - 2, k)."""
    beats = np.where(detuning < NEAR_AN_INTEGER, detuning, 0.0) * lengths
    driving = np.array([name in DRIVING for name in schedule.tuning], dtype=bool)
    by_tuning, driven = np.any(tuned, axis=1), np.any(tuned[:, driving], axis=1)
    jumps, bends = jumped[:, 0] | jumped[:, 2], bent[:, 0] | bent[:, 2]
    begins = np.append(0, 1 + np.flatnonzero(jumps | bends | by_tuning))
    count = ceil(len(begins) / MAX_STAYS)
    begins = begins[::count]
    totals = np.add.reduceat(np.column_stack([lengths, beats]), begins)
    sampled, rates = schedule.sampled(), schedule.rates()
    return tuple(
        Stay(
            periods=length,
            lead=(round(sampled[at, 0] % tau, 9), float(sampled[at, 2])),
            drifts=bool(detuning[at] > SAME or rates[at, 0] or rates[at, 2]),
            tuned=at > 0 and bool(by_tuning[at - 1]),
            driven=at > 0 and bool(driven[at - 1]),
            bends=at > 0 and not (jumps[at - 1] or by_tuning[at - 1]),
            beats=turns,
            count=count,
        )
        for at, (length, turns) in zip(begins.tolist(), totals.tolist(), strict=True)
    )
