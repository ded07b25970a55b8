"""Errors of a run in the needed quantities, and whether it shows a beat."""

from collections.abc import Mapping
from dataclasses import dataclass
from math import inf

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.checks.measures import dominant_frequency, peak
from slider_resonator.device.schedule import nearest
from slider_resonator.fmu.run import Record
from slider_resonator.output.readable import number_of
from slider_resonator.scenes.needs import AllowedTable
from slider_resonator.scenes.scene import Scene
from slider_resonator.steady.searches import SLOW

ROUNDING = {0: 1e-12, 1: 1e-10}
"""Error of the resolved run itself, by friction law, as a share of the magnitude."""


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


@dataclass(frozen=True)
class Readings:
    """The needs of a run, and the times (s) at which it and its reference are read.

    Signals are compared at `points` (n,), numbers at the last of them, and a beat is read at
    `grid` (m,), which is equidistant. `period` (s) is the drive's, `law` the friction law of the
    reference.
    """

    needs: Mapping[str, AllowedTable]
    points: Array
    grid: Array
    period: float
    law: int

    def errors(self, record: Record, reference: Record) -> Estimates:
        """Return the error of each needed quantity, as the table [need] defines it."""
        return {name: self._error(name, record, reference) for name in self.needs}

    def _error(self, name: str, record: Record, reference: Record) -> ErrorEstimate:
        if name == "event_times":
            return self._events(record, reference)
        if name == "beat":
            return self._beat(record, reference)
        signal = name.removesuffix("_throughout")
        points = self.points[-1:] if name == "mean_velocity" else self.points
        if name == "mean_velocity_throughout" and points[-1] > self.period:
            points = points[points >= self.period]  # before, no whole period has ended
        found, true = (_at(points, r, signal) for r in (record, reference))
        rounding = ROUNDING[self.law] * peak(true)
        return ErrorEstimate(max(peak(found - true), rounding), peak(true))

    def _events(self, record: Record, reference: Record) -> ErrorEstimate:
        """Return the largest distance of an event from the nearest one of the reference."""
        found, true = (one.final("reversals") for one in (record, reference))
        if found != true:
            why = f"{number_of(round(found), 'reversal')} instead of {true:.0f}"
            return ErrorEstimate(inf, self.period, why)
        shown = np.unique(_at(self.points, record, "last_event_time"))
        events = np.unique(reference["last_event_time"])
        apart = peak(shown - events[nearest(events, shown)])
        return ErrorEstimate(max(apart, 1e-10 * self.period), self.period)

    def _beat(self, record: Record, reference: Record) -> ErrorEstimate:
        later = self.grid[len(self.grid) // 2 :]
        try:
            found, true = (
                dominant_frequency(later, _at(later, one, "mean_velocity"))
                for one in (record, reference)
            )
        except ValueError as error:
            return ErrorEstimate(inf, 0.0, str(error))
        return ErrorEstimate(max(abs(found - true), ROUNDING[self.law] * true), true)


def _at(points: Array, record: Record, name: str) -> Array:
    return record[name][nearest(record.times, points)]


MIN_BEATS = 2.0
"""Beats in the later half of a run from which their frequency can be read."""


def beat_frequency(scene: Scene) -> float:
    """Return the difference frequency (Hz) at the starting ratio, 0 unless near an integer."""
    ratio = scene.signals["frequency_ratio"].at(0.0)
    detuning = abs(ratio - round(ratio))
    return detuning / scene.drive_period if detuning < SLOW else 0.0


def lacking_beat(scene: Scene) -> str:
    """Return the reason why a run of the scene has no beat, empty where it has one."""
    ratio = scene.signals["frequency_ratio"]
    if len(set(ratio.values)) > 1:
        return "the frequency ratio changes, and the beat with it"
    beat = beat_frequency(scene)
    if beat == 0.0:
        return (
            f"no beat at frequency_ratio = {ratio.values[0]:.9g}: must be within "
            f"{SLOW:g} of an integer, but not at one"
        )
    beats = 0.5 * (scene.stop_time or 0.0) * beat
    if beats < MIN_BEATS:
        return f"the later half of the run has {beats:.2g} beats; {MIN_BEATS:g} show one"
    return ""


def unseen_beat(seen: ErrorEstimate, beat: float) -> str:
    """Return the reason why a frequency read from the resolved run is not `beat`, both in Hz.

    Empty where it is. A slow motion that beats less than it drifts has its strongest oscillation
    elsewhere.
    """
    found = seen.magnitude
    if any(abs(found - n * beat) <= 0.2 * beat for n in (1, 2, 3)):
        return ""
    where = f"no beat of {beat:.4g} Hz in the resolved run"
    return seen.reason or f"{where}: its strongest oscillation has {found:.4g} Hz"
