"""Inputs without the error of holding them, for the run that candidates are compared with."""

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.device.schedule import Schedule, communication_points
from slider_resonator.device.signal import Signal
from slider_resonator.scenes.scene import Scene


def must_hold(scene: Scene, *, interpolates: bool) -> bool:
    """Whether an input or parameter varies other than by jumps, so that holding it is an error.

    Straight lines of inputs are none for who `interpolates`.
    """
    signals = scene.tuning if interpolates else {**scene.signals, **scene.tuning}
    return any(is_line(signal, scene.stop_time or 0.0) for signal in signals.values())


def is_line(signal: Signal, duration: float) -> bool:
    """Whether a signal varies other than by jumps before `duration` (s)."""
    first = signal.at(0.0)
    inside = (v for t, v in zip(signal.times, signal.values, strict=True) if 0.0 < t < duration)
    return not signal.hold and any(value != first for value in (*inside, signal.at(duration)))


def exact_schedule(scene: Scene, points: Array, step: float, *, interpolates: bool) -> Schedule:
    """Return a schedule with at least the communication `points` (s), which begin at 0.

    An FMU that `interpolates` gets the derivatives of straight lines of inputs. What varies
    otherwise is held at its mean over each small step (s): the impulse of the load and the angle
    psi are then exact at the points, and the error is of second order in the step.
    """
    signals, tuning = dict(scene.signals), dict(scene.tuning)
    stop = float(points[-1])
    corners = [t for s in (*signals.values(), *tuning.values()) for t in s.times if 0.0 < t < stop]
    times = np.unique(np.concatenate([points, corners]))
    if must_hold(scene, interpolates=interpolates):
        times = np.union1d(times, communication_points(stop, step, corners))
        middles = times + 0.5 * np.diff(times, append=times[-1])
        for table in (tuning,) if interpolates else (signals, tuning):
            lines = {name: signal for name, signal in table.items() if is_line(signal, stop)}
            means = {name: tuple(s.over(middles).tolist()) for name, s in lines.items()}
            table |= {name: Signal(tuple(times.tolist()), values) for name, values in means.items()}
    return Schedule(times, signals, tuning=tuning, interpolates=interpolates)
