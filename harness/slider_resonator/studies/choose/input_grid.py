"""Inputs as a run holds them from one communication point to the next."""

from __future__ import annotations

from dataclasses import dataclass
from math import tau

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.device.interface import INPUTS
from slider_resonator.device.schedule import Schedule, Signal, communication_points, steps
from slider_resonator.scenes.scene import Scene


@dataclass(frozen=True)
class InputGrid:
    """Values (n, 3) of phase (rad), load (N) and frequency ratio, held from `times` (n,) (s) on."""

    times: Array
    values: Array

    def stretch(self, start: float, stop: float, points: Array, drive_frequency: float) -> Schedule:
        """Return the schedule from `start` on, at a whole drive period, with more points.

        Its times begin at 0. What psi has turned by then is added to the phase: a stretch that does
        not begin with the scene is for a frequency ratio that does not change.
        """
        inside = self.times[(self.times > start) & (self.times < stop)]
        times = np.unique(np.concatenate([[start, stop], inside, points]))
        rows = self.values[np.searchsorted(self.times, times, side="right") - 1]
        if start > 0.0:
            rows[:, 0] += (drive_frequency * start * rows[0, 2]) % tau
        changes = np.flatnonzero(np.any(np.diff(rows, axis=0, prepend=np.nan) != 0.0, axis=1))
        shifted = times - start
        at = shifted[changes].tolist()
        signals = (steps(list(zip(at, column, strict=True))) for column in rows[changes].T.tolist())
        return Schedule(shifted, *signals)


def sampled_inputs(scene: Scene, stop: float, step: float) -> InputGrid:
    """Return the inputs as a run with this step (s) samples and holds them up to `stop` (s)."""
    signals = [scene.signals[name] for name in INPUTS]
    jumps = [time for signal in signals for time in signal.jumps]
    times = communication_points(stop, step, jumps)
    return InputGrid(times, np.column_stack([signal.over(times) for signal in signals]))


def averaged_inputs(scene: Scene, stop: float, step: float, start: float = 0.0) -> InputGrid:
    """Return the inputs held at their mean over each small step (s).

    The impulse of the load and the angle psi are then exact at the points: the error is of second
    order in the step, that of `sampled_inputs` of first.
    """
    signals = [scene.signals[name] for name in INPUTS]
    corners = [time - start for signal in signals for time in signal.times]
    times = start + communication_points(stop - start, step, corners)
    middles = times + 0.5 * np.diff(times, append=times[-1])
    return InputGrid(times, np.column_stack([signal.over(middles) for signal in signals]))


def vary(scene: Scene, duration: float) -> bool:
    """Whether an input varies other than by jumps, so that holding it is an error."""
    return any(
        not signal.hold and len({signal.at(0.0), *_within(signal, duration)}) > 1
        for signal in scene.signals.values()
    )


def _within(signal: Signal, duration: float) -> list[float]:
    inside = [v for t, v in zip(signal.times, signal.values, strict=True) if 0.0 < t < duration]
    return [*inside, signal.at(duration)]
