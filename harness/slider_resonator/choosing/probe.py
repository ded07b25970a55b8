"""What candidates give and cost: runs of the scene with their errors, steady motion.

Runs are compared with a resolved run, or with leaps over periods where these prove to serve.
"""

import gc
import time
from collections.abc import Mapping
from dataclasses import replace
from functools import cached_property
from math import ceil, floor, inf, log2

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.choosing.choice import Candidate
from slider_resonator.choosing.errors import (
    ROUNDING,
    ErrorEstimate,
    Estimates,
    Readings,
    beat_frequency,
    lacking_beat,
    unseen_beat,
)
from slider_resonator.device.model import COULOMB, Model
from slider_resonator.device.schedule import Schedule, communication_points
from slider_resonator.device.signal import Signal
from slider_resonator.errors import FmuError
from slider_resonator.fmu.instance import Instance
from slider_resonator.fmu.run import Record, run
from slider_resonator.scenes.needs import RUN_NEEDS, STEADY_NEEDS
from slider_resonator.scenes.scene import Scene
from slider_resonator.steady.searches import SEARCHES, SteadyAnswer

SIGNALS = ("position", "velocity", "mean_velocity", "reversals", "last_event_time")
WARM_UP = {"fidelity": 2.0, "friction_law": float(COULOMB)}
"""A model that prepares nothing which another one could use."""


def timed_run(
    instance: Instance, parameters: Mapping[str, float], schedule: Schedule
) -> tuple[Record, float]:
    """Return a run and its CPU time (s), in a new instance: an old one may keep tables.

    The host's own first calls are made before, in a small part of the first step. Raises FmuError
    or Refusal where the FMU cannot run it, or gives what is not finite.
    """
    instance.recreate()
    first = replace(schedule, times=schedule.times[:2] * 1e-3)
    run(instance, {**parameters, **WARM_UP}, first, outputs=SIGNALS)
    gc.disable()  # a collection takes tens of ms
    try:
        record = run(instance, parameters, schedule, outputs=SIGNALS)
    finally:
        gc.enable()
    for name in SIGNALS:
        if not np.isfinite(record[name]).all():
            raise FmuError(f"{instance.fmu.path.name}: output {name} is not finite")
    return record, record.start_cpu + record.step_cpu


def find(
    instance: Instance, values: Mapping[str, float], name: str, candidate: Candidate
) -> SteadyAnswer:
    """Return a steady quantity as a candidate gives it: at fidelity 0 the FMU's own output.

    `values` are the parameters and inputs of the scene. The instance is created anew, as an old one
    may keep predictions. Raises FmuError where the FMU refuses.
    """
    given = {**values, **candidate.parameters}
    instance.recreate()
    instance.start({**given, **WARM_UP})
    began = time.process_time()
    if candidate.model.fidelity == 0:
        instance.start(given)
        with instance.explained():
            found = instance.value(name)
        return SteadyAnswer(time.process_time() - began, found)
    search = SEARCHES[name](instance, given)
    seconds = time.process_time() - began
    value = search.value if search.status in (search.settled, "stuck") else None
    return SteadyAnswer(seconds, value, f"{search.status}: {search.reason}", search.periods)


def steady_error(found: SteadyAnswer, reference: SteadyAnswer, law: int) -> ErrorEstimate:
    """Return the error against the resolved quantity; `law` is the friction law of that."""
    if reference.value is None:
        return ErrorEstimate(inf, 0.0, reference.reason)
    if found.value is None:
        return ErrorEstimate(inf, abs(reference.value), found.reason)
    floor = max(1e-10, ROUNDING[law]) * abs(reference.value)  # of a solution by shooting
    return ErrorEstimate(max(abs(found.value - reference.value), floor), abs(reference.value))


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


MAX_STEPS = 10_000
"""Steps of a candidate whose steps can be put together in the probe, or that holds inputs."""
TIMED_STEPS = 2000
"""Steps of a beginning that gives the cost of a candidate whose steps are put together."""
HEAD_PERIODS = 300.0
"""Drive periods from which the CPU time of resolved motion is measured."""
STEPS, MIN_POINTS, MAX_POINTS = 8, 4000, 20_000
"""Points of a reference in a step of the candidate, and in total, where inputs must be held; at
least two in a step."""
MAX_PERIODS = 10_000.0
"""Drive periods in a step of resolved motion: FMUs bound the work of a step."""
SIGNAL_NEEDS = frozenset({"position", "velocity", "mean_velocity_throughout", "event_times"})
"""Needs that are judged at every step of the scene, not at its end only."""


class Probe:
    """One scene in one FMU instance: the errors and costs of its candidates.

    An FMU that takes no derivatives of inputs has them held.
    """

    def __init__(self, instance: Instance, scene: Scene) -> None:
        self.instance = instance
        can_interpolate = instance.fmu.interpolates
        self.inputs = scene.lines_reach(can_interpolate)
        self.scene = scene = scene if can_interpolate else scene.interpolating(False)
        needs = scene.need.needs if scene.need else {}
        self.run_needs = {name: needs[name] for name in RUN_NEEDS if name in needs}
        self.steady_needs = [name for name in STEADY_NEEDS if name in needs]
        self.duration = scene.stop_time or 0.0
        passes_on = scene.run is not None and scene.run.interpolate
        self.varying = must_hold(scene, interpolates=passes_on)
        self.reference_model = Model(2, scene.device.friction_law)
        self.finest = Candidate(self.reference_model, 1e-13, None)
        leaps = replace(self.reference_model, fidelity=0, averaging_order=2)
        # The difference of two tolerances bounds the error of the finer one.
        self._leaps = [Candidate(leaps, tolerance, None) for tolerance in (1e-9, 1e-11)]
        self.no_beat = lacking_beat(scene) if "beat" in self.run_needs else ""
        """Reason why a run shows no beat; empty where it shows one or none is needed."""
        self.averaging_orders = (1, 2) if instance.fmu.has_orders else (None,)
        self.ladder: tuple[float | None, ...] = self._steps() if self.run_needs else (None,)
        self._finest_step = self.ladder[-1] or self.duration
        self.drive_periods = 0.0
        """Drive periods that the FMU has resolved so far, with those of searches."""
        self._references: dict[float, Record] = {}

    def _steps(self) -> tuple[float, ...]:
        """Return the steps (s) to choose from, descending.

        Signals are needed at every step of the scene, which is then the longest; a beat needs some
        steps each, and how many is tried; a number at the end needs one step, or as many as the FMU
        takes. Where something varies and is held, or a beat is read, steps are powers of two of the
        scene's own, in a limited number. Input jumps are communication points in any case.
        """
        period, duration = self.scene.drive_period, self.duration
        own = self.scene.step_size or duration
        allowed = MAX_PERIODS * period
        if SIGNAL_NEEDS & self.run_needs.keys():
            longest = min(duration, own)
        elif self.varying or "beat" in self.run_needs:
            longest = min(duration, allowed)
        else:
            own = longest = duration
        shortest = min(longest, allowed)
        if "beat" in self.run_needs:  # 4 to 8 steps in one show it, 64 to 128 in a run are enough
            frequency = beat_frequency(self.scene)
            beat = 1.0 / frequency if frequency else inf
            shortest = min(shortest, duration / 128, beat / 8.0)
            longest = min(longest, duration / 64, beat / 4.0)
        first = own * 2.0 ** floor(log2(longest / own * (1.0 + 1e-9)))
        halvings = ceil(log2(first / shortest))
        if self.varying:
            # A reference that follows lines of inputs costs no more beside many steps.
            most = 100_000 if self.instance.fmu.interpolates else MAX_STEPS
            halvings = floor(log2(first / min(first, max(period / 64, duration / most))))
        return tuple(first * 2.0**-index for index in range(halvings + 1))

    def measure(self, candidate: Candidate) -> tuple[Estimates, float]:
        """Return errors by need, and cost (s), of a run with a candidate.

        Raises FmuError or Refusal where the FMU cannot run it.
        """
        step = candidate.step or self.duration
        joined = step * self._together(step)
        record, seconds = self._run(candidate, joined, self.duration)
        if joined > step:
            seconds = self.cost(candidate)
        seen = self._readings(step).errors(record, self.reference(step))
        if "beat" in seen and (
            why := self.no_beat or unseen_beat(seen["beat"], beat_frequency(self.scene))
        ):
            seen["beat"] = ErrorEstimate(inf, 0.0, why)
        return seen, seconds

    def cost(self, candidate: Candidate, stop: float = inf) -> float:
        """Return the cost (s) of a run with a candidate, by that up to `stop` (s)."""
        step = candidate.step or self.duration
        most = TIMED_STEPS * step if self._together(step) > 1 else inf
        stop = min(stop, self.duration, most)
        return self._run(candidate, min(step, stop), stop)[1] * self.duration / stop

    def _run(self, candidate: Candidate, step: float, stop: float) -> tuple[Record, float]:
        schedule = self.scene.timed(stop_time=stop, step_size=step).schedule()
        return self._timed(candidate, replace(schedule, start_time=0.0, reads_twice=False))

    def _timed(self, candidate: Candidate, schedule: Schedule) -> tuple[Record, float]:
        if candidate.model.fidelity > 0:
            self.drive_periods += float(schedule.times[-1]) / self.scene.drive_period
        return timed_run(self.instance, {**self.scene.parameters, **candidate.parameters}, schedule)

    def _together(self, step: float) -> int:
        """Return how many steps (s) are put together: an odd number, to meet all phases.

        Where inputs do not vary that makes no error but in averages, on the safe side.
        """
        if self.varying or "beat" in self.run_needs or self.duration <= MAX_STEPS * step:
            return 1
        return ceil(self.duration / step / MAX_STEPS) | 1

    def reference(self, step: float) -> Record:
        """Return what candidates with this step (s) are compared with.

        Raises FmuError or Refusal where the FMU cannot run it.
        """
        key = step if must_hold(self.scene, interpolates=self.instance.fmu.interpolates) else 0.0
        if key not in self._references:
            exact = self._leaps[1] if self.leaps_serve else self.finest
            self._references[key] = self._exact_run(exact, step)[0]
        return self._references[key]

    @cached_property
    def leaps_serve(self) -> bool:
        """Whether leaps cost far less than resolved motion, and are accurate enough.

        The resolved run, estimated by its beginning, must take more than 0.3 s of CPU time and
        three times that of leaps, and two runs with leaps must differ by less than a tenth of what
        the needs allow.
        """
        if not self.instance.fmu.has_orders or "event_times" in self.run_needs:
            return False
        resolved = self.cost(self.finest, HEAD_PERIODS * self.scene.drive_period)
        if resolved <= 0.3:
            return False
        try:
            coarse, seconds = self._exact_run(self._leaps[0], self.duration)
            if 3.0 * seconds > resolved:
                return False
            fine, _ = self._exact_run(self._leaps[1], self.duration)
        except FmuError:
            return False
        errors = self._readings(self._finest_step).errors(coarse, fine)
        return all(
            found.error <= 0.1 * self.run_needs[name].at(found.magnitude)
            for name, found in errors.items()
        )

    def _readings(self, step: float) -> Readings:
        """Return when runs are read: at each of the scene's steps, or at the end.

        A beat of a candidate with a `step` (s) is read at each of these.
        """
        points, grid = np.array([self.duration]), np.empty(0)
        if SIGNAL_NEEDS & self.run_needs.keys():
            own = self.scene.step_size or self.duration
            own *= self._together(own)
            points = self.scene.timed(step_size=own).schedule().times
        if "beat" in self.run_needs:
            grid = communication_points(self.duration, step)[:-1]
        law = self.reference_model.friction_law
        return Readings(self.run_needs, points, grid, self.scene.drive_period, law)

    def _exact_run(self, candidate: Candidate, step: float) -> tuple[Record, float]:
        """Return a run without the error of held inputs, and its CPU time (s).

        Where inputs must be held, it is a reference of candidates with a `step` (s).
        """
        readings = self._readings(self._finest_step)
        points = np.union1d(np.append(readings.points, 0.0), readings.grid)
        if candidate.model.fidelity > 0:
            pieces = np.arange(0.0, self.duration, MAX_PERIODS * self.scene.drive_period)
            points = np.union1d(points, pieces)
        fine = min(step / STEPS, self.duration / MIN_POINTS)
        while self.duration / fine > MAX_POINTS and fine < 0.5 * step:
            fine *= 2.0
        interpolates = self.instance.fmu.interpolates
        schedule = exact_schedule(self.scene, points, fine, interpolates=interpolates)
        return self._timed(candidate, schedule)
