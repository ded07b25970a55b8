"""Whether the velocity was held, and whether design and proof agree."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from harness.closed_loop.course import Array, Course
from harness.closed_loop.duty import Duty, Hold


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
    """Largest difference (m/s) between design and proof, when (s), and the error predicted (m/s).

    Counted from the first settling on.
    """

    host: str
    difference: float
    time: float
    predicted: float
    passed: bool


def judge_holds(course: Course, duty: Duty) -> list[Held]:
    """Judge one course, load by load."""
    return [_held(course, duty, hold) for hold in duty.holds]


def _held(course: Course, duty: Duty, hold: Hold) -> Held:
    slack = 1e-6 * duty.step
    inside = (course.times > hold.start + slack) & (course.times < hold.end + slack)
    since = course.times[inside] - hold.start
    deviation = np.abs(course.velocity[inside] / duty.reference - 1.0)
    outside = np.flatnonzero(deviation > duty.band)
    first = int(outside[-1]) + 1 if outside.size else 0
    after = float(deviation[since > duty.settling - slack].max())
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


def differences(design: Course, proof: Course, duty: Duty) -> tuple[Array, Array]:
    """Return times (s) and |velocity of design - of proof| (m/s) from the first settling on."""
    settled = design.times > duty.settling - 1e-6 * duty.step
    return design.times[settled], np.abs(design.velocity - proof.velocity)[settled]


def judge_agreement(design: Course, proof: Course, duty: Duty, predicted: float) -> Agreement:
    """Compare the two courses of a host; `predicted` (m/s) is the error of the design's model."""
    times, difference = differences(design, proof, duty)
    worst = int(np.argmax(difference))
    largest = float(difference[worst])
    return Agreement(design.host, largest, float(times[worst]), predicted, largest <= predicted)
