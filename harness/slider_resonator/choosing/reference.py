"""The run that candidates are compared with: resolved, or by leaps where these prove to serve.

Its inputs are without the error of holding them.
"""

from functools import cached_property

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.choosing.candidate import MAX_PERIODS, Candidate
from slider_resonator.choosing.errors import Readings
from slider_resonator.choosing.steady_need import timed_run
from slider_resonator.device.model import Model
from slider_resonator.device.schedule import Schedule, communication_points
from slider_resonator.device.signal import Signal
from slider_resonator.errors import FmuError
from slider_resonator.fmu.instance import Instance
from slider_resonator.fmu.run import Record
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


FINEST_TOLERANCE = 1e-13
"""Tolerance of the resolved LuGre device."""
LEAP_TOLERANCES = (1e-9, 1e-11)
"""Tolerances of two runs with leaps, whose difference bounds the error of the finer one."""
TRUSTED = 0.1
"""Share of an allowed error up to which these may differ."""
SHORT = 0.3
"""CPU time (s) of the resolved run up to which it is always made."""
GAIN = 3.0
"""Quotient of CPU times from which on leaps gain enough for a second run."""
HEAD_PERIODS = 300.0
"""Drive periods from which the CPU time of resolved motion is measured."""
STEPS, MIN_POINTS, MAX_POINTS = 8, 4000, 20_000
"""Points of a reference in a step of the candidate, and in total, where inputs must be held; at
least two in a step."""


class Reference:
    """The reference runs of a scene; FmuError or Refusal where the FMU cannot make them.

    `stop` (s) is their end, `drive_periods` counts what was resolved.
    """

    def __init__(self, instance: Instance, scene: Scene, readings: Readings) -> None:
        self.drive_periods = 0.0
        self._instance = instance
        self._scene = scene
        self.readings = readings
        self.stop = scene.stop_time or 0.0
        self._model = Model(2, scene.device.friction_law)
        self._leaps = Model(0, self._model.friction_law, 2) if instance.fmu.has_orders else None
        self._records: dict[float, Record] = {}

    @cached_property
    def seconds(self) -> float:
        """CPU time (s) of the resolved run, by that of its beginning."""
        head = min(self.stop, HEAD_PERIODS * self._scene.drive_period)
        return self._run(self._model, FINEST_TOLERANCE, head, head)[1] * self.stop / head

    @cached_property
    def leaps(self) -> bool:
        """Whether leaps are cheaper by far than the resolved run, and accurate enough."""
        if self._leaps is None or "event_times" in self.readings.needs or self.seconds <= SHORT:
            return False
        try:
            coarse, seconds = self._run(self._leaps, LEAP_TOLERANCES[0], self.stop, self.stop)
            if GAIN * seconds > self.seconds:
                return False
            fine, _ = self._run(self._leaps, LEAP_TOLERANCES[1], self.stop, self.stop)
        except FmuError:
            return False
        errors = self.readings.errors(coarse, fine)
        return all(
            errors[name].error <= TRUSTED * need.at(errors[name].magnitude)
            for name, need in self.readings.needs.items()
        )

    def record(self, step: float) -> Record:
        """Return the reference of candidates with this step (s)."""
        key = step if must_hold(self._scene, interpolates=self._instance.fmu.interpolates) else 0.0
        if key not in self._records:
            leaps = self._leaps if self.leaps else None
            tolerance = LEAP_TOLERANCES[-1] if leaps else FINEST_TOLERANCE
            self._records[key] = self._run(leaps or self._model, tolerance, self.stop, step)[0]
        return self._records[key]

    def _run(
        self, model: Model, tolerance: float, stop: float, step: float
    ) -> tuple[Record, float]:
        """Run a model up to `stop` (s), with inputs as for candidates with this step (s)."""
        points = np.union1d(self.readings.points, self.readings.grid)
        points = np.concatenate([[0.0], points[(points > 0.0) & (points < stop)], [stop]])
        if model.fidelity > 0:
            self.drive_periods += stop / self._scene.drive_period
            pieces = np.arange(0.0, stop, MAX_PERIODS * self._scene.drive_period)
            points = np.union1d(points, pieces)
        fine = min(step / STEPS, stop / MIN_POINTS)
        while stop / fine > MAX_POINTS and fine < 0.5 * step:
            fine *= 2.0
        interpolates = self._instance.fmu.interpolates
        schedule = exact_schedule(self._scene, points, fine, interpolates=interpolates)
        values = {**self._scene.parameters, **Candidate(model, tolerance, None).parameters}
        return timed_run(self._instance, values, schedule)
