"""A long scene from short windows: errors of a candidate there, extrapolated between them.

Averaged motion, which is cheap, gives the slow motion throughout the scene. From there candidate
and resolved device run for some hundred drive periods under the same inputs. They drift apart by a
defect d of the slow acceleration; between the windows the slow velocity decays at a rate r, known
from averaged motion too, so that the difference u of the velocities obeys u' = d - r u, from the
end of the resolved beginning to that of the scene.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from math import ceil, log

import numpy as np

from slider_resonator.checks.measures.deviation import peak
from slider_resonator.fmu.instance import Instance
from slider_resonator.fmu.run import run
from slider_resonator.scenes.scene import Scene
from slider_resonator.studies.choose.errors import ErrorEstimate, Estimates
from slider_resonator.studies.choose.held_grid import averaged_inputs, sampled_inputs
from slider_resonator.studies.choose.scales import Scales
from slider_resonator.studies.choose.stretch import Samples, Stretch, follow

WINDOWS = 6
WINDOW_PERIODS = 240
CHECKPOINTS = 24
"""Whole drive periods in a window at which the slow velocities are compared."""
MEMORIES = 6.0
"""Memories of the resonator after which its own start is forgotten."""
MAX_SETTLING = 0.5
"""Largest share of a window that this may take."""
SLOW_STEPS = 1000
"""Steps in which averaged motion is followed through the scene, and u is integrated."""
NUDGE = 1e-3
"""Perturbation of the slow velocity, in fast velocities, from which its decay is measured."""
FORGOTTEN = 1e-6
"""Share of the perturbation that counts as zero."""
SIZE_POINTS = 400
SAFETY = 1.2
"""Safety factor on errors extrapolated between windows."""


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
    """Return the drive periods after which only the slow motion is left in a window."""
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
    held = averaged_inputs(scene, duration, duration / SLOW_STEPS)
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
        checkpoints = start + period * counts
        stretch = Stretch(start, float(checkpoints[-1]), checkpoints, initial)
        nudge = NUDGE * (scales.fast_velocity or 0.0)
        pushed = {**initial, "initial_velocity": initial["initial_velocity"] + nudge}
        ends = [
            follow(instance, scene, slow, held, Stretch(start, stretch.stop, checkpoints, values))[
                "mean_velocity"
            ][-1]
            for values in (initial, pushed)
        ]
        left = float(ends[1] - ends[0]) / nudge if nudge else 1.0
        rate = -log(max(left, FORGOTTEN)) / (stretch.stop - start)
        windows.append(Window(stretch, rate))
    return Windows(tuple(windows), sizes)


def holding_errors(
    instance: Instance, scene: Scene, duration: float, step: float
) -> dict[str, float]:
    """Return the errors that averaged motion makes by holding the inputs over each step (s)."""
    slow = {"fidelity": 0.0, "friction_law": float(scene.device.friction_law)}
    checkpoints = step * np.arange(1, int(duration / step))
    stretch = Stretch(0.0, duration, np.append(checkpoints[checkpoints < duration], duration))
    held = follow(instance, scene, slow, sampled_inputs(scene, duration, step), stretch)
    meant = follow(instance, scene, slow, averaged_inputs(scene, duration, step / 4.0), stretch)
    apart = {name: np.abs(held[name] - meant[name]) for name in ("mean_velocity", "position")}
    return {
        "mean_velocity": float(apart["mean_velocity"][-1]),
        "velocity": float(apart["mean_velocity"].max()),
        "position": float(apart["position"].max()),
    }


def with_holding(estimates: Mapping[str, ErrorEstimate], added: Mapping[str, float]) -> Estimates:
    """Return errors with those of holding the inputs added."""
    return {
        name: replace(estimate, error=estimate.error + added.get(name, 0.0))
        for name, estimate in estimates.items()
    }


@dataclass(frozen=True)
class Defect:
    """The error of a candidate in a window.

    `acceleration` (m/s^2) of the slow velocity at `time` (s), the `rate` (1/s) of the window, the
    largest error `fast` (m/s) of the velocity and `ripple` (m) of the position beside their drift.
    """

    time: float
    rate: float
    acceleration: float
    fast: float
    ripple: float


def defect(window: Window, samples: Samples, reference: Samples, scales: Scales) -> Defect:
    """Compare a candidate with the resolved run of the same window."""
    stretch = window.stretch
    since = samples.times - stretch.start
    apart = samples["mean_velocity"] - reference["mean_velocity"]
    settled = since >= settling(scales) * scales.period
    kept = np.exp(-window.rate * since)
    gathered = -np.expm1(-window.rate * since) / window.rate if window.rate else since
    basis = np.column_stack([kept, gathered])[settled]
    _, push = np.linalg.lstsq(basis, apart[settled], rcond=None)[0]
    moved = samples["position"] - reference["position"]
    drift = np.polyval(np.polyfit(since[settled], moved[settled], 2), since[settled])
    fast = samples["velocity"] - reference["velocity"]
    return Defect(
        time=0.5 * (stretch.start + stretch.stop),
        rate=window.rate,
        acceleration=float(push),
        fast=float(np.abs(fast[settled] - apart[settled]).max()),
        ripple=float(np.abs(moved[settled] - drift).max()),
    )


def extrapolated(
    defects: Sequence[Defect],
    sizes: Mapping[str, float],
    head: Samples,
    reference: Samples,
    seen: Mapping[str, ErrorEstimate],
    duration: float,
) -> Estimates:
    """Return the errors over the whole scene; `seen` are those over its beginning.

    `head` and `reference` cover the beginning. `sizes` are those of `Windows`.
    """
    begin = float(head.times[-1])
    u = float(head["mean_velocity"][-1] - reference["mean_velocity"][-1])
    x = float(head["position"][-1] - reference["position"][-1])
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
    over_all = {}
    for name, size in sizes.items():
        if name in seen:
            floor = 0.0 if name == "mean_velocity" else seen[name].error
            over_all[name] = ErrorEstimate(max(SAFETY * later[name], floor), size)
    return {**seen, **over_all}
