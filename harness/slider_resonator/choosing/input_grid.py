"""Inputs and tuned parameters as a run gets them at communication points."""

from __future__ import annotations

from dataclasses import dataclass
from math import tau

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.device.interface import INPUTS
from slider_resonator.device.schedule import Schedule, communication_points
from slider_resonator.device.signal import Signal, steps
from slider_resonator.scenes.scene import Scene


@dataclass(frozen=True)
class InputGrid:
    """Values (n, 3 + k) from `times` (n,) (s) on: phase (rad), load (N), frequency ratio, tuning.

    `names` (3 + k) are those of the columns. Those in `lines` are straight lines between the times,
    of which the FMU gets the derivatives; all others are held.
    """

    times: Array
    values: Array
    names: tuple[str, ...] = tuple(INPUTS)
    lines: frozenset[str] = frozenset()

    def stretch(self, start: float, stop: float, points: Array, drive_frequency: float) -> Schedule:
        """Return the schedule from `start` on, at a whole drive period, with more points.

        Its times begin at 0. What psi has turned by then is added to the phase: a stretch that does
        not begin with the scene is for a frequency ratio and a drive that do not change.
        """
        inside = self.times[(self.times > start) & (self.times < stop)]
        times = np.unique(np.concatenate([[start, stop], inside, points]))
        rows = self.values[np.searchsorted(self.times, times, side="right") - 1]
        for column, name in enumerate(self.names):
            if name in self.lines:
                rows[:, column] = np.interp(times, self.times, self.values[:, column])
        if start > 0.0:
            rows[:, 0] += (drive_frequency * start * rows[0, 2]) % tau
        shifted = times - start
        signals = {
            name: _line(shifted, column) if name in self.lines else _held(shifted, column)
            for name, column in zip(self.names, rows.T, strict=True)
        }
        tuning = {name: signal for name, signal in signals.items() if name not in INPUTS}
        inputs = (signals[name] for name in INPUTS)
        return Schedule(shifted, *inputs, tuning=tuning, interpolates=bool(self.lines))


def _line(times: Array, values: Array) -> Signal:
    return Signal(tuple(times.tolist()), tuple(values.tolist()), hold=False)


def _held(times: Array, values: Array) -> Signal:
    changes = np.flatnonzero(np.diff(values, prepend=np.nan) != 0.0)
    return steps(list(zip(times[changes].tolist(), values[changes].tolist(), strict=True)))


def sampled_inputs(scene: Scene, stop: float, step: float) -> InputGrid:
    """Return the inputs as a run with this step (s) gets them up to `stop` (s).

    They are sampled at its communication points and held, but for the straight lines of a scene
    that passes them on.
    """
    signals = _signals(scene)
    lines = _passed_on(scene)
    points = [time for signal in signals.values() for time in signal.jumps]
    points += [time for name in lines for time in signals[name].times]
    return _grid(signals, communication_points(stop, step, points), lines)


def inputs_as_they_vary(
    scene: Scene, stop: float, step: float, start: float = 0.0, *, interpolates: bool
) -> InputGrid:
    """Return the inputs with next to no error of holding them, from `start` to `stop` (s).

    Where the FMU `interpolates`, straight lines of inputs are passed on. What varies otherwise is
    held at its mean over each small step (s): the impulse of the load and the angle psi are then
    exact at the points, the error is of second order in the step, that of `sampled_inputs` of
    first.
    """
    signals = _signals(scene)
    lines = _lines(scene) if interpolates else frozenset[str]()
    corners = [time - start for signal in signals.values() for time in signal.times]
    size = step if must_hold(scene, interpolates=interpolates) else stop - start
    times = start + communication_points(stop - start, size, corners)
    middles = times + 0.5 * np.diff(times, append=times[-1])
    grid = _grid(signals, times, lines)
    for column, (name, signal) in enumerate(signals.items()):
        if name not in lines:
            grid.values[:, column] = signal.over(middles)
    return grid


def _grid(signals: dict[str, Signal], times: Array, lines: frozenset[str]) -> InputGrid:
    values = np.column_stack([signal.over(times) for signal in signals.values()])
    return InputGrid(times, values, tuple(signals), lines)


def _signals(scene: Scene) -> dict[str, Signal]:
    """Return inputs and tuning by name, the inputs first and in their order."""
    return {**{name: scene.signals[name] for name in INPUTS}, **scene.tuning}


def must_hold(scene: Scene, *, interpolates: bool) -> bool:
    """Whether something varies that `inputs_as_they_vary` holds over small steps."""
    lines = _lines(scene) if interpolates else frozenset[str]()
    return any(_is_line(signal) for name, signal in _signals(scene).items() if name not in lines)


def _passed_on(scene: Scene) -> frozenset[str]:
    """Return the inputs that a run of the scene passes on as straight lines."""
    interpolates = scene.run is not None and scene.run.interpolate
    return _lines(scene) if interpolates else frozenset()


def _lines(scene: Scene) -> frozenset[str]:
    """Return the inputs that can be passed on as straight lines."""
    found = (name for name in INPUTS if _is_line(scene.signals[name]))
    return frozenset(found)


def _is_line(signal: Signal) -> bool:
    return not signal.hold and len(set(signal.values)) > 1


def vary(scene: Scene, duration: float) -> bool:
    """Whether an input or parameter varies other than by jumps, so that holding it is an error.

    Straight lines of inputs are none in a scene that passes them on.
    """
    lines = _passed_on(scene)
    return any(
        name not in lines and len({signal.at(0.0), *_within(signal, duration)}) > 1
        for name, signal in _signals(scene).items()
        if not signal.hold
    )


def _within(signal: Signal, duration: float) -> list[float]:
    inside = [v for t, v in zip(signal.times, signal.values, strict=True) if 0.0 < t < duration]
    return [*inside, signal.at(duration)]
