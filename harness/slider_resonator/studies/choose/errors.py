"""How wrong a course is in what the scene needs."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from math import inf

import numpy as np

from slider_resonator.checks.measures.deviation import peak
from slider_resonator.checks.measures.frequency import dominant_frequency
from slider_resonator.studies.choose.candidate import COULOMB
from slider_resonator.studies.choose.course import Course

ROUNDING = {0: 1e-12, 1: 1e-10}
"""What even the resolved run leaves open, by friction law, as a share of the size."""
EVENT_ROUNDING = 1e-10
"""The same for the times of events, as a share of the drive period."""


@dataclass(frozen=True)
class Wrong:
    """The error of a quantity and its size, both in its unit.

    `error` is infinite where there is no such quantity, `reason` says why then.
    """

    error: float
    size: float
    reason: str = ""


def errors(
    names: Iterable[str], course: Course, truth: Course, period: float, law: int = COULOMB
) -> dict[str, Wrong]:
    """Return what each needed quantity of a run is off, as `Quantity` of that name defines it.

    Signals are compared at their looks, numbers at the end. `period` (s) is the drive's, `law` the
    friction law of the truth.
    """
    measures = {
        "mean_velocity": lambda: _difference(course, truth, "mean_velocity", slice(-1, None)),
        "position": lambda: _difference(course, truth, "position", slice(None)),
        "velocity": lambda: _difference(course, truth, "velocity", slice(None)),
        "event_times": lambda: _events(course, truth, period),
        "beat": lambda: _beat(course, truth),
    }
    found = {name: measures[name]() for name in names}
    floors = {name: ROUNDING[law] * wrong.size for name, wrong in found.items()}
    if "event_times" in floors:
        floors["event_times"] = EVENT_ROUNDING * period
    return {
        name: Wrong(max(wrong.error, floors[name]), wrong.size, wrong.reason)
        for name, wrong in found.items()
    }


def _difference(course: Course, truth: Course, name: str, part: slice) -> Wrong:
    there = truth[name][part]
    return Wrong(peak(course[name][part] - there), peak(there))


def _events(course: Course, truth: Course, period: float) -> Wrong:
    """Return the largest distance of an event that is shown from the nearest true one."""
    if course["reversals"][-1] != truth["reversals"][-1]:
        counts = f"{course['reversals'][-1]:.0f} reversals instead of {truth['reversals'][-1]:.0f}"
        return Wrong(inf, period, counts)
    shown, true = np.unique(course["last_event_time"]), np.unique(truth["last_event_time"])
    after = np.searchsorted(true, shown).clip(max=len(true) - 1)
    before = (after - 1).clip(min=0)
    nearest = np.minimum(np.abs(shown - true[after]), np.abs(shown - true[before]))
    return Wrong(peak(nearest), period)


def _beat(course: Course, truth: Course) -> Wrong:
    try:
        true, found = _beat_frequency(truth), _beat_frequency(course)
    except ValueError as error:
        return Wrong(inf, 0.0, str(error))
    return Wrong(abs(found - true), true)


def _beat_frequency(course: Course) -> float:
    half = len(course.grid_times) // 2
    return dominant_frequency(course.grid_times[half:], course.grid_velocity[half:])
