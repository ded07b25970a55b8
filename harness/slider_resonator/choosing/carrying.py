"""The error of a candidate in windows, carried from one to the next to the end of the scene.

In a window the difference u of the slow velocities is measured; what of u is older than the window
decays as averaged motion does. Between windows u' = d - r u, with the defect d of the slow
acceleration and the decay rate r of the windows on both sides.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import exp, expm1, log

import numpy as np
from numpy.typing import NDArray

from slider_resonator.arrays import Array
from slider_resonator.choosing.errors import ErrorEstimate, Estimates
from slider_resonator.choosing.stretch import Samples
from slider_resonator.choosing.windows import Window

GAP_STEPS = 200
"""Steps in which u is integrated between two windows."""
FORGOTTEN = 1e-6
"""Share of a difference that counts as zero."""
SAFETY = 1.2
"""Safety factor on errors carried through windows."""


@dataclass(frozen=True)
class Push:
    """A defect of the slow acceleration (m/s^2) and the decay rate (1/s) of what it causes."""

    acceleration: float
    rate: float


@dataclass(frozen=True)
class Defect:
    """The error of a candidate in a window.

    `offset` (m/s) is the difference of the slow velocities at the start, as settled motion shows
    it; `apart` (n,) (m/s) and `moved` (n,) (m) are the differences of mean velocity and position,
    and `fast` (n,) (m/s) that of the velocity beside them. `before` the first corner and `after`
    the last one has been forgotten; None where nothing is left of the window to read it from.
    """

    window: Window
    offset: float
    apart: Array
    moved: Array
    fast: Array
    before: Push | None
    after: Push | None


@dataclass(frozen=True)
class Drift:
    """What is carried: differences of slow velocity (m/s) and position (m), and their largest."""

    velocity: float
    position: float
    largest_velocity: float
    largest_position: float


def defect(window: Window, samples: Samples, reference: Samples, period: float) -> Defect:
    """Compare a candidate with the resolved run of the same window."""
    times = samples.times
    apart = samples["mean_velocity"] - reference["mean_velocity"]
    turns = (times - window.stretch.start) / period
    whole = np.abs(turns - np.round(turns)) < 1e-6
    first = window.corners[0] if window.corners else np.inf
    before = _fit(window, apart, whole & (times >= window.settled) & (times <= first))
    after = before
    if window.corners:
        after = _fit(window, apart, whole & (times >= window.calm))
    return Defect(
        window=window,
        offset=before[0] if before else 0.0,
        apart=apart,
        moved=samples["position"] - reference["position"],
        fast=samples["velocity"] - reference["velocity"] - apart,
        before=before[1] if before else None,
        after=after[1] if after else None,
    )


def _fit(window: Window, apart: Array, chosen: NDArray[np.bool_]) -> tuple[float, Push] | None:
    """Return the difference (m/s) extrapolated back to the start of the window, and the push."""
    since = (window.stretch.checkpoints - window.stretch.start)[chosen]
    if since.size < 3:
        return None
    rate = _decay_rate(window, chosen)
    left = np.exp(-rate * since)
    gathered = -np.expm1(-rate * since) / rate if rate else since
    found = np.linalg.lstsq(np.column_stack([left, gathered]), apart[chosen], rcond=None)[0]
    return float(found[0]), Push(float(found[1]), rate)


def _decay_rate(window: Window, chosen: NDArray[np.bool_]) -> float:
    """Return the rate (1/s) at which a difference decays there, or before it is forgotten."""
    lasting = window.kept > FORGOTTEN
    at = np.flatnonzero(lasting & chosen)
    at = at if at.size > 1 else np.flatnonzero(lasting)
    if at.size < 2:
        return 0.0
    (begin, end), kept = window.stretch.checkpoints[at[[0, -1]]], window.kept[at[[0, -1]]]
    return -log(kept[1] / kept[0]) / float(end - begin)


def carried(
    defects: Sequence[Defect], velocity: float, position: float, start: float
) -> tuple[Drift, float]:
    """Carry the differences of velocity (m/s) and position (m) at `start` (s) through the windows.

    Returns the drift at the end of the last window and the largest difference (m/s) of velocities.
    """
    drift = Drift(velocity, position, abs(velocity), abs(position))
    fast, behind = 0.0, None
    for each in defects:
        stretch = each.window.stretch
        ahead = each.before or each.after
        drift = _between(drift, behind or ahead, ahead or behind, stretch.start - start)
        drift, largest = _through(each, drift)
        fast = max(fast, largest)
        start, behind = stretch.stop, each.after or behind
    return drift, max(fast, drift.largest_velocity)


def _between(drift: Drift, behind: Push | None, ahead: Push | None, length: float) -> Drift:
    """Carry a drift through a gap (s) between two windows."""
    if length <= 0.0 or behind is None or ahead is None:
        return drift
    u, x = drift.velocity, drift.position
    largest_u, largest_x = drift.largest_velocity, drift.largest_position
    size = length / GAP_STEPS
    for step in range(GAP_STEPS):
        share = (step + 0.5) / GAP_STEPS
        push = behind.acceleration + share * (ahead.acceleration - behind.acceleration)
        rate = behind.rate + share * (ahead.rate - behind.rate)
        gathered = -expm1(-rate * size) / rate if rate else size
        later = u * exp(-rate * size) + push * gathered
        x += 0.5 * size * (u + later)
        u = later
        largest_u, largest_x = max(largest_u, abs(u)), max(largest_x, abs(x))
    return Drift(u, x, largest_u, largest_x)


def _through(each: Defect, drift: Drift) -> tuple[Drift, float]:
    """Carry a drift through a window; also returns its largest error of the velocity (m/s)."""
    window, times = each.window, each.window.stretch.checkpoints
    seen = np.flatnonzero(times >= window.settled)
    older = (drift.velocity - each.offset) * window.kept
    u = (older + each.apart)[seen]
    began = times[seen[0]] - window.stretch.start
    grown = np.diff(times[seen]) * 0.5 * (older[seen][1:] + older[seen][:-1])
    x = drift.position + 0.5 * began * (drift.velocity + u[0])
    x = x + np.append(0.0, np.cumsum(grown)) + each.moved[seen] - each.moved[seen[0]]
    return Drift(
        velocity=float(u[-1]),
        position=float(x[-1]),
        largest_velocity=max(drift.largest_velocity, float(np.abs(u).max())),
        largest_position=max(drift.largest_position, float(np.abs(x).max())),
    ), float(np.abs(u + each.fast[seen]).max())


def over_the_scene(
    drift: Drift, velocity: float, sizes: Mapping[str, float], seen: Mapping[str, ErrorEstimate]
) -> Estimates:
    """Return the errors over the whole scene; `seen` are those over its beginning.

    `velocity` (m/s) is the largest error of the velocity in windows, `sizes` those of `Windows`.
    """
    later = {
        "mean_velocity": abs(drift.velocity),
        "velocity": velocity,
        "position": drift.largest_position,
    }
    over_all = {}
    for name, size in sizes.items():
        if name in seen:
            floor = 0.0 if name == "mean_velocity" else seen[name].error
            over_all[name] = ErrorEstimate(max(SAFETY * later[name], floor), size)
    return {**seen, **over_all}
