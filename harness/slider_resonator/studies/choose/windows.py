"""A long scene from short windows: what a candidate errs there, carried on between them.

Averaged motion, which costs next to nothing, says where the slow motion is in the course of the
scene. From there candidate and resolved device are followed alike for some hundred drive periods.
They drift apart by a defect d of the slow acceleration; in between the slow velocity forgets what
it was at a rate r that averaged motion tells as well, so that the difference u of the velocities
obeys u' = d - r u, from the end of the resolved beginning to that of the scene.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import ceil, log

import numpy as np
from numpy.typing import NDArray

from slider_resonator.checks.measures.deviation import peak
from slider_resonator.fmu.instance import Instance
from slider_resonator.fmu.run import run
from slider_resonator.scenes.scene import Scene
from slider_resonator.studies.choose.course import Course, Stretch, follow
from slider_resonator.studies.choose.errors import Wrong
from slider_resonator.studies.choose.held import as_meant, as_run
from slider_resonator.studies.choose.scales import Scales

Array = NDArray[np.float64]

WINDOWS = 6
WINDOW_PERIODS = 240
CHECKPOINTS = 24
"""Whole drive periods in a window at which the slow velocities are compared."""
MEMORIES = 6.0
"""Memories of the resonator after which its own start no longer shows."""
MOST_SETTLING = 0.5
"""Share of a window that the resonator may take for it."""
SLOW_STEPS = 1000
"""Steps in which averaged motion is followed through the scene, and u is integrated."""
NUDGE = 1e-3
"""Change of the slow velocity, in fast velocities, that shows how it is forgotten."""
FORGOTTEN = 1e-6
"""Share of a nudge that counts as none."""
SIZE_POINTS = 400
SAFETY = 1.2
"""By which an error that is carried, and not seen, is enlarged."""


@dataclass(frozen=True)
class Window:
    """A stretch that starts in the slow motion of the scene, which forgets at a `rate` (1/s)."""

    stretch: Stretch
    rate: float


@dataclass(frozen=True)
class Windows:
    """The windows of a long scene, and the sizes of the needed quantities in all of it."""

    windows: tuple[Window, ...]
    sizes: Mapping[str, float]


def settling(scales: Scales) -> float:
    """Return the drive periods after which a window shows the slow motion alone."""
    return max(2.0, MEMORIES * scales.memory)


def lay_windows(
    instance: Instance, scene: Scene, scales: Scales, duration: float, head: float
) -> Windows:
    """Return windows evenly spread from `head` (s) to the end of the scene.

    The last whole drive period of the scene is in the last. Raises FmuError where averaged motion
    does not exist.
    """
    period = scales.period
    first, last = ceil(head / period), int(duration / period) - WINDOW_PERIODS
    starts = np.unique(np.linspace(first, last, WINDOWS).round()) * period
    slow = {"fidelity": 0.0, "friction_law": float(scene.device.friction_law)}
    held = as_meant(scene, duration, duration / SLOW_STEPS)
    points = np.union1d(starts, np.linspace(0.0, duration, SIZE_POINTS))
    schedule = held.stretch(0.0, duration, points, scene.device.drive_frequency)
    states = ("velocity", "resonator_displacement", "resonator_velocity")
    outputs = (*states, "position", "mean_velocity")
    record = run(instance, {**scene.parameters, **slow}, schedule, outputs=outputs)
    sizes = {
        "mean_velocity": abs(record.final("mean_velocity")),
        "position": peak(record["position"]),
        "velocity": peak(record["mean_velocity"]) + (scales.fast_velocity or 0.0),
    }
    windows = []
    for start in starts.tolist():
        index = int(np.searchsorted(record.times, start))
        initial = {f"initial_{name}": float(record[name][index]) for name in states}
        initial |= {"initial_position": 0.0, "initial_bristle_deflection": 0.0}
        counts = np.arange(1, CHECKPOINTS + 1) * (WINDOW_PERIODS // CHECKPOINTS)
        looks = start + period * counts
        stretch = Stretch(start, float(looks[-1]), looks, initial)
        nudge = NUDGE * (scales.fast_velocity or 0.0)
        pushed = {**initial, "initial_velocity": initial["initial_velocity"] + nudge}
        ends = [
            follow(instance, scene, slow, held, Stretch(start, stretch.stop, looks, values))[
                "mean_velocity"
            ][-1]
            for values in (initial, pushed)
        ]
        left = float(ends[1] - ends[0]) / nudge if nudge else 1.0
        rate = -log(max(left, FORGOTTEN)) / (stretch.stop - start)
        windows.append(Window(stretch, rate))
    return Windows(tuple(windows), sizes)


def holding(instance: Instance, scene: Scene, duration: float, step: float) -> dict[str, float]:
    """Return the errors that averaged motion makes by holding the inputs over each step (s)."""
    slow = {"fidelity": 0.0, "friction_law": float(scene.device.friction_law)}
    looks = step * np.arange(1, int(duration / step))
    stretch = Stretch(0.0, duration, np.append(looks[looks < duration], duration))
    held = follow(instance, scene, slow, as_run(scene, duration, step), stretch)
    meant = follow(instance, scene, slow, as_meant(scene, duration, step / 4.0), stretch)
    apart = {name: np.abs(held[name] - meant[name]) for name in ("mean_velocity", "position")}
    return {
        "mean_velocity": float(apart["mean_velocity"][-1]),
        "velocity": float(apart["mean_velocity"].max()),
        "position": float(apart["position"].max()),
    }


def with_holding(
    wrong: Mapping[str, Wrong], holding_errors: Mapping[str, float]
) -> dict[str, Wrong]:
    """Return errors with those of holding the inputs added."""
    return {
        name: Wrong(w.error + holding_errors.get(name, 0.0), w.size, w.reason)
        for name, w in wrong.items()
    }


@dataclass(frozen=True)
class Defect:
    """What a candidate errs in a window.

    `acceleration` (m/s^2) of the slow velocity at `time` (s), the `rate` (1/s) of the window, the
    largest error `fast` (m/s) of the velocity and `ripple` (m) of the position beside their drift.
    """

    time: float
    rate: float
    acceleration: float
    fast: float
    ripple: float


def defect(window: Window, course: Course, truth: Course, scales: Scales) -> Defect:
    """Compare a candidate with the resolved run of the same window."""
    stretch = window.stretch
    since = course.times - stretch.start
    apart = course["mean_velocity"] - truth["mean_velocity"]
    settled = since >= settling(scales) * scales.period
    kept = np.exp(-window.rate * since)
    gathered = -np.expm1(-window.rate * since) / window.rate if window.rate else since
    basis = np.column_stack([kept, gathered])[settled]
    _, push = np.linalg.lstsq(basis, apart[settled], rcond=None)[0]
    moved = course["position"] - truth["position"]
    drift = np.polyval(np.polyfit(since[settled], moved[settled], 2), since[settled])
    fast = course["velocity"] - truth["velocity"]
    return Defect(
        time=0.5 * (stretch.start + stretch.stop),
        rate=window.rate,
        acceleration=float(push),
        fast=float(np.abs(fast[settled] - apart[settled]).max()),
        ripple=float(np.abs(moved[settled] - drift).max()),
    )


def carried(
    defects: Sequence[Defect],
    sizes: Mapping[str, float],
    head: Course,
    truth: Course,
    seen: Mapping[str, Wrong],
    duration: float,
) -> dict[str, Wrong]:
    """Return the errors over the whole scene; `seen` are those over its beginning.

    `head` and `truth` cover the beginning. `sizes` are those of `Windows`.
    """
    begin = float(head.times[-1])
    u = float(head["mean_velocity"][-1] - truth["mean_velocity"][-1])
    x = float(head["position"][-1] - truth["position"][-1])
    times = np.array([d.time for d in defects])
    grid = np.linspace(begin, duration, SLOW_STEPS)
    pushes = np.interp(grid, times, [d.acceleration for d in defects])
    rates = np.interp(grid, times, [d.rate for d in defects])
    size = float(grid[1] - grid[0])
    largest_u, largest_x = abs(u), abs(x)
    for push, rate in zip(pushes.tolist(), rates.tolist(), strict=True):
        before = u
        u = (u + size * push) / (1.0 + size * rate) if rate > 0.0 else u + size * (push - rate * u)
        x += 0.5 * size * (before + u)
        largest_u, largest_x = max(largest_u, abs(u)), max(largest_x, abs(x))
    fast = max(d.fast for d in defects)
    ripple = max(d.ripple for d in defects)
    later = {
        "mean_velocity": abs(u),
        "velocity": largest_u + fast,
        "position": largest_x + ripple,
    }
    carried_over = {}
    for name, size in sizes.items():
        if name in seen:
            least = 0.0 if name == "mean_velocity" else seen[name].error
            carried_over[name] = Wrong(max(SAFETY * later[name], least), size)
    return {**seen, **carried_over}
