"""Errors of a run in the needed quantities."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from math import inf

import numpy as np

from slider_resonator.checks.measures.deviation import peak
from slider_resonator.checks.measures.frequency import dominant_frequency
from slider_resonator.choosing.candidate import COULOMB
from slider_resonator.choosing.stretch import Samples
from slider_resonator.device.schedule import nearest

ROUNDING = {0: 1e-12, 1: 1e-10}
"""Error of the resolved run itself, by friction law, as a share of the magnitude."""
EVENT_ROUNDING = 1e-10
"""The same for the times of events, as a share of the drive period."""


@dataclass(frozen=True)
class ErrorEstimate:
    """Error and magnitude of a quantity, both in its unit.

    `error` is infinite where there is no such quantity; `reason` then says why.
    """

    error: float
    magnitude: float
    reason: str = ""


Estimates = dict[str, ErrorEstimate]
"""Errors by need."""


def errors(
    names: Iterable[str], samples: Samples, reference: Samples, period: float, law: int = COULOMB
) -> Estimates:
    """Return the error of each needed quantity of a run, as `Quantity` of that name defines it.

    Signals are compared at their checkpoints, numbers at the end. `period` (s) is the drive's,
    `law` the friction law of the reference.
    """
    measures = {
        "mean_velocity": lambda: _difference(samples, reference, "mean_velocity", slice(-1, None)),
        "position": lambda: _difference(samples, reference, "position", slice(None)),
        "velocity": lambda: _difference(samples, reference, "velocity", slice(None)),
        "event_times": lambda: _events(samples, reference, period),
        "beat": lambda: _beat(samples, reference),
    }
    found = {name: measures[name]() for name in names}
    floors = {name: ROUNDING[law] * estimate.magnitude for name, estimate in found.items()}
    if "event_times" in floors:
        floors["event_times"] = EVENT_ROUNDING * period
    return {
        name: ErrorEstimate(max(estimate.error, floors[name]), estimate.magnitude, estimate.reason)
        for name, estimate in found.items()
    }


def _difference(samples: Samples, reference: Samples, name: str, part: slice) -> ErrorEstimate:
    there = reference[name][part]
    return ErrorEstimate(peak(samples[name][part] - there), peak(there))


def _events(samples: Samples, reference: Samples, period: float) -> ErrorEstimate:
    """Return the largest distance of an event from the nearest one of the reference."""
    if samples["reversals"][-1] != reference["reversals"][-1]:
        counts = (
            f"{samples['reversals'][-1]:.0f} reversals instead of {reference['reversals'][-1]:.0f}"
        )
        return ErrorEstimate(inf, period, counts)
    shown, true = np.unique(samples["last_event_time"]), np.unique(reference["last_event_time"])
    return ErrorEstimate(peak(shown - true[nearest(true, shown)]), period)


def _beat(samples: Samples, reference: Samples) -> ErrorEstimate:
    try:
        true, found = _beat_frequency(reference), _beat_frequency(samples)
    except ValueError as error:
        return ErrorEstimate(inf, 0.0, str(error))
    return ErrorEstimate(abs(found - true), true)


def _beat_frequency(samples: Samples) -> float:
    half = len(samples.grid_times) // 2
    return dominant_frequency(samples.grid_times[half:], samples.grid_velocity[half:])
