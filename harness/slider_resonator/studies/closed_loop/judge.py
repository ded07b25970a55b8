"""Whether the velocity was held, and whether design and proof agree."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from slider_resonator.studies.closed_loop.course import Array, Course
from slider_resonator.studies.closed_loop.duty import Duty, Hold


@dataclass(frozen=True)
class Held:
    """How the velocity fared under one load (N) from `start` (s) on.

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


def judge_holds(course: Course, duty: Duty) -> list[Held]:
    """Judge one course, load by load."""
    return [_held(course, duty, hold) for hold in duty.holds]


def _held(course: Course, duty: Duty, hold: Hold) -> Held:
    inside = _inside(course.times, duty, hold)
    since = course.times[inside] - hold.start
    deviation = np.abs(course.velocity[inside] / duty.reference - 1.0)
    outside = np.flatnonzero(deviation > duty.band)
    first = int(outside[-1]) + 1 if outside.size else 0
    after = float(deviation[since > duty.settling - 1e-6 * duty.step].max())
    return Held(
        host=course.host,
        fidelity=course.fidelity,
        start=hold.start,
        load=hold.load,
        largest=float(deviation.max()),
        settled=float(since[first]) if first < len(since) else None,
        after_settling=after,
        passed=after <= duty.band,
    )


def judge_agreement(
    design: Course, proof: Course, duty: Duty, predicted: Sequence[float | None]
) -> list[Agreement]:
    """Compare the two courses of a host from each step of the load on, with what is predicted.

    `predicted` has the error (m/s) of averaged motion for each of the duty's load steps. The whole
    answer of the loop counts, not only what it settles to: that is the reference in any case.
    """
    difference = np.abs(design.velocity - proof.velocity)
    found = []
    for hold, error in zip(duty.load_steps, predicted, strict=True):
        inside = np.flatnonzero(_inside(design.times, duty, hold))
        worst = inside[np.argmax(difference[inside])]
        largest, time = float(difference[worst]), float(design.times[worst])
        passed = error is not None and largest <= error
        found.append(Agreement(design.host, hold.start, hold.load, largest, time, error, passed))
    return found


def _inside(times: Array, duty: Duty, hold: Hold) -> NDArray[np.bool_]:
    """Return which times are under a load: from the end of its first step on."""
    slack = 1e-6 * duty.step
    return (times > hold.start + slack) & (times < hold.end + slack)
