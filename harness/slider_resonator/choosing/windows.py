"""Windows of a long scene: where candidate and resolved device are compared, and from which state.

Averaged motion, which is cheap, gives the slow motion throughout the scene. From there candidate
and resolved device run for some hundred drive periods under the same inputs: evenly through the
scene, across each corner of the inputs, which kicks the two apart, and to the very end.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import ceil, floor

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.checks.measures.deviation import peak
from slider_resonator.choosing.candidate import Model
from slider_resonator.choosing.input_grid import inputs_as_they_vary
from slider_resonator.choosing.scales import Scales, longest_memory
from slider_resonator.choosing.stretch import GOLDEN, Stretch, follow
from slider_resonator.device.interface import INPUTS
from slider_resonator.fmu.instance import Instance
from slider_resonator.fmu.record import Record
from slider_resonator.fmu.run import run
from slider_resonator.scenes.scene import Scene

WINDOWS = 6
"""Windows spread through the time of a scene, besides those across corners."""
WINDOWS_PER_CHANGE = 4
"""Windows spread through each change of the slow velocity by the fast one."""
MAX_SPREAD = 40
"""Maximum number of windows that are spread."""
WINDOW_PERIODS = 240
"""Drive periods of such a window."""
FIT_PERIODS = 60
"""Drive periods from which a defect is read, before and after a corner."""
SPACING = 10
"""Drive periods between the points at which the slow velocities are compared."""
MEMORIES = 6.0
"""Memories of resonator and bristle after which the start of a window is forgotten."""
SLOW_STEPS = 1000
"""Steps in which averaged motion is followed through the scene."""
NUDGE = 1e-3
"""Perturbation of the slow velocity, in fast velocities, from which its decay is measured."""
SIZE_POINTS = 400


@dataclass(frozen=True)
class Window:
    """A stretch that starts in the slow motion of the scene.

    `kept` (n,) is the share of a difference of the slow velocity at its start that is left at each
    checkpoint. Up to `settled` (s) the motion of the resonator is its own, not that of the scene.
    `corners` (s) of the inputs are those inside, and the last of them is forgotten at `calm` (s).
    """

    stretch: Stretch
    kept: Array
    settled: float
    corners: tuple[float, ...]
    calm: float


@dataclass(frozen=True)
class Windows:
    """The windows of a long scene, and the sizes of the needed quantities in all of it.

    `final_velocity` (m/s) is the mean velocity at the end of the scene by averaged motion.
    """

    windows: tuple[Window, ...]
    sizes: Mapping[str, float]
    final_velocity: float


def settling(scales: Scales, law: int) -> float:
    """Return the drive periods after which only the slow motion is left in a window."""
    return max(2.0, MEMORIES * longest_memory(scales, law))


def corner_periods(scene: Scene, duration: float) -> list[float]:
    """Return when inputs jump or change their slope, in drive periods, ascending."""
    times = {t for name in INPUTS for t in scene.signals[name].times if 0.0 < t < duration}
    return [time / scene.drive_period for time in sorted(times)]


def head_end(periods: float, corners: Sequence[float], settle: float) -> int:
    """Return the whole drive periods of a beginning that ends apart from all corners."""
    end = ceil(periods)
    for corner in corners:
        if end - settle < corner <= end + settle + FIT_PERIODS + 1:
            end = ceil(corner + settle) + 1
    return end


def even_starts(first: float, end: float) -> list[float]:
    """Return starts of windows, in drive periods, evenly spread from `first` to the end."""
    return [float(start) for start in np.linspace(first, end - WINDOW_PERIODS, WINDOWS)]


def starts_along(times: Array, slow_velocity: Array, fast_velocity: float) -> list[float]:
    """Return starts of windows spread through the time and the changes of the slow velocity.

    `times` (n,) are in any unit, which the starts have too; the velocities are in m/s.
    """
    changes = np.append(0.0, np.cumsum(np.abs(np.diff(slow_velocity)))) / fast_velocity
    lengths = WINDOWS * (times - times[0]) / (times[-1] - times[0]) + WINDOWS_PER_CHANGE * changes
    count = min(MAX_SPREAD, ceil(float(lengths[-1])))
    return [float(t) for t in np.interp(np.linspace(0.0, lengths[-1], count), lengths, times)]


def places(
    first: int, end: float, corners: Sequence[float], settle: float, starts: Sequence[float]
) -> list[tuple[int, float]]:
    """Return where windows start and stop, in drive periods, from `first` to the end of the scene.

    They do not overlap, and each corner is far enough from both for a fit, but at the end. `starts`
    are those of windows besides the ones across corners.
    """
    lead = ceil(settle) + FIT_PERIODS
    last = max(first, floor(end) - WINDOW_PERIODS)
    begins = [min(last, round(start)) for start in starts]
    spans = [(start, float(start + WINDOW_PERIODS)) for start in begins] + [(last, end)]
    spans += [(floor(c) - lead, float(ceil(c) + lead)) for c in corners if c > first]
    merged: list[tuple[int, float]] = []
    for start, stop in sorted(spans):
        begin = max(first, start)
        if merged and begin <= merged[-1][1]:
            begin, before = merged.pop()
            stop = max(before, stop)
        merged.append((begin, min(stop, end)))
    return merged


def lay_windows(
    instance: Instance, scene: Scene, averaged: Model, scales: Scales, head: float
) -> Windows:
    """Return the windows from `head` (s), a whole number of drive periods, to the end of the scene.

    `averaged` is the model of the slow motion. Raises FmuError where there is none.
    """
    period = scales.period
    duration, slow = scene.stop_time or 0.0, averaged.parameters
    held = inputs_as_they_vary(
        scene, duration, duration / SLOW_STEPS, interpolates=instance.fmu.interpolates
    )
    states = ("velocity", "resonator_displacement", "resonator_velocity")

    def record_at(points: Array) -> Record:
        schedule = held.stretch(0.0, duration, points, scene.device.drive_frequency)
        outputs = (*states, "position", "mean_velocity")
        return run(instance, {**scene.parameters, **slow}, schedule, outputs=outputs)

    grid = np.linspace(0.0, duration, SIZE_POINTS)
    record = record_at(grid)
    corners = corner_periods(scene, duration)
    settle = settling(scales, averaged.friction_law)
    later = record.times >= head
    spread = even_starts(head / period, duration / period)
    if scales.fast_velocity:
        times, velocity = record.times[later] / period, record["mean_velocity"][later]
        spread = starts_along(times, velocity, scales.fast_velocity)
    spans = places(round(head / period), duration / period, corners, settle, spread)
    starts = period * np.array([start for start, _ in spans], dtype=np.float64)
    record = record_at(np.union1d(starts, grid))
    sizes = {
        "mean_velocity": abs(record.final("mean_velocity")),
        "position": peak(record["position"]),
        "velocity": peak(record["mean_velocity"]) + (scales.fast_velocity or 0.0),
    }
    nudge = NUDGE * (scales.fast_velocity or 0.0)
    windows = []
    for start, (first, stop) in zip(starts.tolist(), spans, strict=True):
        index = int(np.searchsorted(record.times, start))
        initial = {f"initial_{name}": float(record[name][index]) for name in states}
        initial |= {"initial_position": 0.0, "initial_bristle_deflection": 0.0}
        pushed = {**initial, "initial_velocity": initial["initial_velocity"] + nudge}
        checkpoints = _checkpoints(first, stop, period, duration)
        ends = [
            follow(
                *(instance, scene, slow, held),
                Stretch(start, float(checkpoints[-1]), checkpoints, values),
            )["mean_velocity"]
            for values in (initial, pushed)
        ]
        kept = (ends[1] - ends[0]) / nudge if nudge else np.ones_like(checkpoints)
        inside = [period * corner for corner in corners if first < corner < stop]
        windows.append(
            Window(
                Stretch(start, float(checkpoints[-1]), checkpoints, initial),
                kept,
                start + settle * period,
                tuple(inside),
                (inside[-1] if inside else start) + (settle + 1.0) * period,
            )
        )
    return Windows(tuple(windows), sizes, record.final("mean_velocity"))


def _checkpoints(first: int, stop: float, period: float, duration: float) -> Array:
    """Return the points (s) of a window: at whole periods, between them at all phases, its stop."""
    whole = np.arange(first + SPACING, stop, SPACING, dtype=np.float64)
    between = whole - SPACING + 0.5 * SPACING + (GOLDEN * np.arange(len(whole))) % 1.0
    inside = np.union1d(whole, between)
    return np.append(period * inside[inside < stop - 0.5], min(period * stop, duration))
