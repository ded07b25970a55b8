"""Whether the velocity was held, and whether design and proof agree."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from slider_resonator.arrays import Array
from studies.closed_loop.duty import Duty, LoadInterval
from studies.closed_loop.loop import LoopRecord

AGREEMENT = 1e-6
"""Difference (m/s) of two fidelities that always counts as agreement."""


@dataclass(frozen=True)
class IntervalResult:
    """Deviation of the velocity under one load (N) from `start` (s) on.

    `largest` is the largest deviation, `after_settling` that after the time allowed for settling,
    both in shares of the reference; `settled` (s) is when the velocity was within the band for
    good, counted from `start`, None if never.
    """

    host: str
    fidelity: int
    start: float
    load: float
    largest: float
    settled: float | None
    after_settling: float
    passed: bool


@dataclass(frozen=True)
class Agreement:
    """Largest difference (m/s) of the mean velocities after a step to a load (N), and when (s).

    `predicted` (m/s) is None where averaged motion was predicted not to do.
    """

    host: str
    start: float
    load: float
    difference: float
    time: float
    predicted: float | None
    passed: bool


def judge_interval(record: LoopRecord, duty: Duty, interval: LoadInterval) -> IntervalResult:
    """Judge one record under one load."""
    inside = _inside(record.times, duty, interval)
    since = record.times[inside] - interval.start
    deviation = np.abs(record.velocity[inside] / duty.reference - 1.0)
    outside = np.flatnonzero(deviation > duty.band)
    first = int(outside[-1]) + 1 if outside.size else 0
    after = float(deviation[since > duty.settling - 1e-6 * duty.step].max())
    return IntervalResult(
        host=record.host,
        fidelity=record.fidelity,
        start=interval.start,
        load=interval.load,
        largest=float(deviation.max()),
        settled=float(since[first]) if first < len(since) else None,
        after_settling=after,
        passed=after <= duty.band,
    )


def judge_agreement(
    design: LoopRecord, proof: LoopRecord, duty: Duty, predicted: Sequence[float | None]
) -> list[Agreement]:
    """Compare the two records of a host from each load step on, to predicted errors or `AGREEMENT`.

    `predicted` has the error (m/s) of averaged motion for each of the duty's load steps. The whole
    answer of the loop counts, not only what it settles to: that is the reference in any case.
    """
    difference = np.abs(design.velocity - proof.velocity)
    found = []
    for interval, error in zip(duty.load_steps, predicted, strict=True):
        inside = np.flatnonzero(_inside(design.times, duty, interval))
        worst = inside[np.argmax(difference[inside])]
        largest, time = float(difference[worst]), float(design.times[worst])
        passed = error is not None and largest <= max(error, AGREEMENT)
        found.append(
            Agreement(design.host, interval.start, interval.load, largest, time, error, passed)
        )
    return found


def _inside(times: Array, duty: Duty, interval: LoadInterval) -> NDArray[np.bool_]:
    """Return which times are under a load: from the end of its first step on."""
    slack = 1e-6 * duty.step
    return (times > interval.start + slack) & (times < interval.end + slack)
