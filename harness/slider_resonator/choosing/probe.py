"""The errors and the cost of candidates, measured in runs of the scene."""

from dataclasses import replace
from functools import cached_property
from math import ceil, inf

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.choosing.candidate import SIGNAL_NEEDS, Candidate, step_ladder
from slider_resonator.choosing.errors import (
    ErrorEstimate,
    Estimates,
    Readings,
    beat_frequency,
    lacking_beat,
    unseen_beat,
)
from slider_resonator.choosing.reference import Reference, must_hold
from slider_resonator.choosing.steady_need import timed_run
from slider_resonator.device.model import Model
from slider_resonator.device.schedule import communication_points
from slider_resonator.fmu.instance import Instance
from slider_resonator.fmu.run import Record
from slider_resonator.scenes.scene import Scene
from slider_resonator.scenes.schema import RUN_NEEDS, STEADY_NEEDS

MAX_STEPS = 10_000
"""Steps of a candidate whose steps can be put together in the probe, or that holds inputs."""
TIMED_STEPS = 2000
"""Steps of a beginning that gives the cost of a candidate whose steps are put together."""
MAX_FOLLOWED_STEPS = 100_000
"""Steps of a candidate beside a reference that follows lines of inputs, where inputs vary."""
LONGEST = 60.0
"""CPU time (s) of a resolved run of a whole scene, where leaps do not serve."""
CAUTION = 3.0
"""Safety factor on errors extrapolated from the beginning, besides their growth with time."""


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
        self.run_needs = [name for name in RUN_NEEDS if name in needs]
        self.steady_needs = [name for name in STEADY_NEEDS if name in needs]
        self.duration = scene.stop_time or 0.0
        passes_on = scene.run is not None and scene.run.interpolate
        self.varying = must_hold(scene, interpolates=passes_on)
        self.reference_model = Model(2, scene.device.friction_law)
        self.averaging_orders = (1, 2) if instance.fmu.has_orders else (None,)
        self.ladder: tuple[float | None, ...] = (None,)
        self._finest = self.duration
        if self.run_needs:
            most = MAX_FOLLOWED_STEPS if can_interpolate else MAX_STEPS
            self.ladder = ladder = step_ladder(scene, self.run_needs, most, varying=self.varying)
            self._finest = ladder[-1]
        self._periods = 0.0

    @property
    def covers(self) -> str:
        """What the errors were compared with: "whole", "leaps" over the whole, or "beginning"."""
        if self._reference.stop < self.duration:
            return "beginning"
        return "leaps" if self._reference.leaps else "whole"

    @property
    def drive_periods(self) -> float:
        """Drive periods that the FMU has resolved so far in runs."""
        return self._periods + (self._reference.drive_periods if self.run_needs else 0.0)

    def resolve(self) -> None:
        """Make the reference; raises FmuError or Refusal where the FMU cannot."""
        self._reference.record(self.ladder[0] or self.duration)

    def measure(self, candidate: Candidate) -> tuple[Estimates, float]:
        """Return errors by need, and cost (s), of a run with a candidate.

        Raises FmuError or Refusal where the FMU cannot run it.
        """
        step = candidate.step or self.duration
        joined, stop = step * self._together(step), self._reference.stop
        record, seconds = self._run(candidate, joined, stop)
        if joined > step:
            seconds = self.cost(candidate) * stop / self.duration
        reference, grid = self._reference.record(step), self._grid(step)
        seen = replace(self._reference.readings, grid=grid).errors(record, reference)
        if "beat" in seen and (
            why := self.no_beat or unseen_beat(seen["beat"], beat_frequency(self.scene))
        ):
            seen["beat"] = ErrorEstimate(inf, 0.0, why)
        if stop < self.duration and candidate.model != self.reference_model:
            why = "the scene is too long for a resolved run of all of it, and leaps do not serve"
            seen = {name: replace(one, error=inf, reason=why) for name, one in seen.items()}
        elif stop < self.duration:  # the errors of the resolved model grow up to the end
            growth = CAUTION * self.duration / stop
            for name in seen.keys() - {"beat"}:
                seen[name] = replace(seen[name], error=growth * seen[name].error)
        return seen, seconds * self.duration / stop

    def cost(self, candidate: Candidate, stop: float = inf) -> float:
        """Return the cost (s) of a run with a candidate, by that up to `stop` (s)."""
        step = candidate.step or self.duration
        most = TIMED_STEPS * step if self._together(step) > 1 else inf
        stop = min(stop, self._reference.stop, most)
        return self._run(candidate, min(step, stop), stop)[1] * self.duration / stop

    def _run(self, candidate: Candidate, step: float, stop: float) -> tuple[Record, float]:
        if candidate.model.fidelity > 0:
            self._periods += stop / self.scene.drive_period
        scene = _cut(self.scene, stop).timed(step_size=step)
        schedule = replace(scene.schedule(), start_time=0.0, reads_twice=False)
        return timed_run(self.instance, {**scene.parameters, **candidate.parameters}, schedule)

    def _together(self, step: float) -> int:
        """Return how many steps (s) are put together: an odd number, to meet all phases.

        Where inputs do not vary that makes no error but in averages, on the safe side.
        """
        if self.varying or "beat" in self.run_needs or self.duration <= MAX_STEPS * step:
            return 1
        return ceil(self.duration / step / MAX_STEPS) | 1

    @cached_property
    def no_beat(self) -> str:
        """The reason why a run shows no beat; empty where it shows one or none is needed."""
        return lacking_beat(self.scene) if "beat" in self.run_needs else ""

    @cached_property
    def _reference(self) -> Reference:
        """The reference, of the beginning where the scene cannot be run as a whole."""
        whole = Reference(self.instance, self.scene, self._read(self.scene))
        if whole.seconds <= LONGEST or whole.leaps:
            return whole
        cut = _cut(self.scene, self.duration * LONGEST / whole.seconds)
        return Reference(self.instance, cut, self._read(cut))

    def _read(self, scene: Scene) -> Readings:
        """Return when a scene is read: at each of its own steps, or at its end only."""
        stop = scene.stop_time or 0.0
        points = np.array([stop])
        if SIGNAL_NEEDS & set(self.run_needs):
            own = scene.step_size or stop
            points = scene.timed(step_size=own * self._together(own)).schedule().times
        assert scene.need is not None
        needs = {name: scene.need.needs[name] for name in self.run_needs}
        grid, law = self._grid(self._finest, stop), scene.device.friction_law
        return Readings(needs, points, grid, scene.drive_period, law)

    def _grid(self, step: float, stop: float | None = None) -> Array:
        """Return the times (s) at which a candidate with this step (s) shows a beat."""
        if "beat" not in self.run_needs:
            return np.empty(0)
        return communication_points(stop or self._reference.stop, step)[:-1]


def _cut(scene: Scene, stop: float) -> Scene:
    """Return the scene up to a time (s)."""
    if scene.run is None or stop == scene.stop_time:
        return scene
    run = scene.run.model_copy(update={"stop_time": stop, "drive_periods": None})
    return replace(scene, run=run)
