"""A stretch of a scene, run with one candidate."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.choosing.input_grid import InputGrid
from slider_resonator.errors import FmuError
from slider_resonator.fmu.instance import Instance
from slider_resonator.fmu.run import run
from slider_resonator.scenes.scene import Scene

SIGNALS = ("position", "velocity", "mean_velocity", "reversals", "last_event_time")
MAX_CHECKPOINTS = 20_000
"""Maximum number of points at which signals are compared."""
GOLDEN = 0.6180339887498949
NO_POINTS = np.empty(0)


@dataclass(frozen=True)
class Stretch:
    """From `start` to `stop` (s), with the `checkpoints` (n,) (s) at which signals are compared.

    `start` is a whole number of drive periods. `initial` holds the initial values of a stretch that
    begins later than the scene.
    """

    start: float
    stop: float
    checkpoints: Array
    initial: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True)
class Samples:
    """Outputs by name (n,) at the checkpoints of a stretch, `times` in s from the scene's start.

    `grid_velocity` (m,) is the mean velocity at `grid_times` (m,) (s), equidistant
    points for a spectrum.
    """

    times: Array
    signals: Mapping[str, Array]
    grid_times: Array
    grid_velocity: Array

    def __getitem__(self, name: str) -> Array:
        """Return an output at the checkpoints."""
        return self.signals[name]


def checkpoints_between(points: Array, start: float, stop: float) -> Array:
    """Return some of the points (s) in [start, stop), and stop, at irregular distances.

    Equal distances could sample a single phase of the vibration.
    """
    inside = points[(points >= start) & (points < stop)]
    if inside.size > MAX_CHECKPOINTS:
        index = np.arange(MAX_CHECKPOINTS)
        places = (index + (GOLDEN * index) % 1.0) * (inside.size / MAX_CHECKPOINTS)
        inside = inside[np.unique(places.astype(np.int64))]
    return np.append(inside, stop)


def follow(
    instance: Instance,
    scene: Scene,
    parameters: Mapping[str, float],
    held: InputGrid,
    stretch: Stretch,
    grid: Array = NO_POINTS,
) -> Samples:
    """Run a stretch; FmuError or Refusal where the FMU cannot, or gives what is not finite.

    `grid` (m,) (s) are points of the stretch for `Samples.grid_times`.
    """
    points = np.union1d(stretch.checkpoints, grid)
    frequency = scene.device.drive_frequency
    schedule = held.stretch(stretch.start, stretch.stop, points, frequency)
    values = {**scene.parameters, **stretch.initial, **parameters}
    record = run(instance, values, schedule, outputs=SIGNALS)
    at = np.searchsorted(schedule.times, stretch.checkpoints - stretch.start)
    signals = {name: record[name][at] for name in SIGNALS}
    signals["last_event_time"] = signals["last_event_time"] + stretch.start
    for name, values_there in signals.items():
        if not np.isfinite(values_there).all():
            raise FmuError(f"{instance.fmu.path.name}: output {name} is not finite")
    on_grid = np.searchsorted(schedule.times, grid - stretch.start)
    return Samples(stretch.checkpoints, signals, grid, record["mean_velocity"][on_grid])
