"""The short resolved probe: a candidate and the resolved device over the same part of a scene."""

from __future__ import annotations

from dataclasses import replace
from functools import cached_property
from math import inf

import numpy as np
from numpy.typing import NDArray

from slider_resonator.device.interface import INPUTS
from slider_resonator.fmu.instance import Instance
from slider_resonator.scenes.scene import Scene
from slider_resonator.scenes.schema import RUN_NEEDS, STEADY_NEEDS
from slider_resonator.studies.choose.candidate import Candidate, Model
from slider_resonator.studies.choose.cost import period_cost
from slider_resonator.studies.choose.course import Course, Stretch, follow, looks_between
from slider_resonator.studies.choose.errors import Wrong, errors
from slider_resonator.studies.choose.held import HeldGrid, as_meant, as_run, vary
from slider_resonator.studies.choose.scales import NEAR_AN_INTEGER, scales_of
from slider_resonator.studies.choose.windows import (
    MOST_SETTLING,
    WINDOW_PERIODS,
    WINDOWS,
    Windows,
    carried,
    defect,
    holding,
    lay_windows,
    settling,
    with_holding,
)

Array = NDArray[np.float64]

FINEST_TOLERANCE = 1e-13
"""Of the resolved LuGre device that candidates are held against."""
TRUTH_STEPS = 8
"""Steps of the resolved run in one step of a candidate, where inputs vary."""
MOST_POINTS = 20_000
"""Points of a resolved run, where inputs vary; at least two in a step of the candidate."""
HOLDING_STEPS = 500
"""Steps of averaged motion that tell the error of holding the inputs."""
WINDOW_STEPS = 4
"""Steps in a drive period, in windows, that follow inputs as they vary."""
MOST_STEPS = 10_000
"""Steps of a candidate in the probe, where inputs vary."""
SHORT, LONG = 3000.0, 30_000.0
"""Drive periods of a scene that is always resolved as a whole, and of one that can be."""
HEAD_PERIODS, FEWEST_PERIODS = 1000.0, 100.0
"""Drive periods that are resolved at the beginning of a longer scene."""
CHEAP_PERIOD = 3e-6
"""Seconds of a drive period up to which those numbers hold; of dearer ones there are fewer."""
CAUTION = 3.0
"""By which errors seen in the beginning are enlarged beside their growth with time."""
MOST_SLOWNESS = 0.05
"""Friction over vibration with which averaged motion can say what happens between windows."""
MOST_CORNERS = 2 * WINDOWS
"""Changes of course of the inputs that windows can be expected to show."""
BEATS = 0.25
"""Beats between two windows, and not more, that windows can show."""
FEWEST_BEATS = 2.0
"""Beats in the later half of a run from which their frequency can be read."""
SIGNAL_NEEDS = frozenset({"position", "velocity", "event_times"})
"""Needs that are judged wherever the scene looks, not at its end only."""


class Probe:
    """One scene in one FMU instance: what its candidates get wrong.

    `covers` tells how much of the scene is resolved for it: "whole", "windows" or "beginning".
    """

    def __init__(self, instance: Instance, scene: Scene) -> None:
        self.instance = instance
        self.scene = scene
        self.scales = scales_of(scene)
        needs = scene.need.needs if scene.need else {}
        self.run_needs = [name for name in RUN_NEEDS if name in needs]
        self.steady_needs = [name for name in STEADY_NEEDS if name in needs]
        self.duration = scene.stop_time or 0.0
        self.varying = vary(scene, self.duration)
        self.truth_model = Model(2, scene.device.friction_law)
        self.drive_periods = 0.0
        self._truths: dict[tuple[float, float], Course] = {}
        self._carried_errors: dict[Candidate, dict[str, Wrong]] = {}
        self._holdings: dict[float, dict[str, float]] = {}

    @cached_property
    def covers(self) -> str:
        """How much of the scene is resolved."""
        periods = self._weight * self.duration / self.scales.period
        points = self.duration / (self.scene.step_size or inf) if self._steps_often else 0.0
        if periods <= SHORT and points <= MOST_STEPS:
            return "whole"
        if self._shows_in_windows():
            return "windows"
        return "whole" if periods <= LONG and points <= MOST_STEPS else "beginning"

    @property
    def probed_duration(self) -> float:
        """Length (s) of the longest stretch that is resolved."""
        if self.covers == "whole":
            return self.duration
        periods = max(FEWEST_PERIODS, HEAD_PERIODS / self._weight)
        return min(periods * self.scales.period, self.duration)

    @property
    def _weight(self) -> float:
        """What a resolved drive period costs, in those of cheap devices."""
        cost = period_cost(self.truth_model, FINEST_TOLERANCE, self.scales)
        return max(1.0, cost / CHEAP_PERIOD)

    @property
    def _steps_often(self) -> bool:
        """Whether every step of the scene's own must be taken, as its inputs vary."""
        return self.varying and bool(SIGNAL_NEEDS & set(self.run_needs))

    def resolve(self, step: float) -> None:
        """Run the resolved device as for a candidate with this step (s).

        Raises FmuError or Refusal where the FMU cannot: then there is nothing to hold others to.
        """
        self._truth(step, self._head)

    def run_errors(self, candidate: Candidate) -> dict[str, Wrong]:
        """Return what a run with the candidate gets wrong, at most what the probe can tell.

        Raises FmuError or Refusal where the FMU cannot run it.
        """
        step = candidate.step or self.duration
        if self.covers == "windows":
            return with_holding(self._carried(candidate, step), self._holding(step))
        course = self._follow(candidate, self._as_run(step), self._head)
        seen = self._seen(course, self._truth(step, self._head))
        return seen if self.covers == "whole" else self._grown(candidate, seen)

    def _seen(self, course: Course, truth: Course) -> dict[str, Wrong]:
        law = self.truth_model.friction_law
        seen = errors(self.run_needs, course, truth, self.scales.period, law)
        return {**seen, "beat": Wrong(inf, 0.0, self.no_beat)} if self.no_beat else seen

    def _carried(self, candidate: Candidate, step: float) -> dict[str, Wrong]:
        """Return the errors of a candidate with inputs as they vary, from head and windows."""
        key = replace(candidate, step=None if self.varying else step)
        if key not in self._carried_errors:
            head, truth = self._alike(candidate, step, self._head)
            defects = [
                defect(window, *self._alike(candidate, step, window.stretch), self.scales)
                for window in self._windows.windows
            ]
            seen, sizes = self._seen(head, truth), self._windows.sizes
            self._carried_errors[key] = carried(defects, sizes, head, truth, seen, self.duration)
        return self._carried_errors[key]

    def _alike(self, candidate: Candidate, step: float, stretch: Stretch) -> tuple[Course, Course]:
        """Return candidate and resolved device under the same inputs."""
        held = self._as_they_vary(step, stretch)
        return self._follow(candidate, held, stretch), self._truth(step, stretch)

    def _holding(self, step: float) -> dict[str, float]:
        """Return what holding the inputs over a step (s) adds to the errors.

        It hardly depends on the model and is of first order in the step, so that averaged motion in
        coarse steps tells.
        """
        if not self.varying:
            return {}
        coarse = max(step, self.duration / HOLDING_STEPS)
        if coarse not in self._holdings:
            self._holdings[coarse] = holding(self.instance, self.scene, self.duration, coarse)
        return {name: error * step / coarse for name, error in self._holdings[coarse].items()}

    def _grown(self, candidate: Candidate, seen: dict[str, Wrong]) -> dict[str, Wrong]:
        """Return the errors of the resolved model itself as they can have grown by the end."""
        if candidate.model != self.truth_model:
            reason = "the scene is too long, and changes too often, for a short probe to confirm it"
            return {name: Wrong(inf, wrong.size, reason) for name, wrong in seen.items()}
        growth = CAUTION * self.duration / self.probed_duration
        return {
            name: wrong if name == "beat" else Wrong(growth * wrong.error, wrong.size)
            for name, wrong in seen.items()
        }

    def _shows_in_windows(self) -> bool:
        """Whether windows at some places show all that happens in the scene."""
        signals = [self.scene.signals[name] for name in INPUTS]
        corners = sum(0.0 < time < self.duration for s in signals for time in s.times)
        beats = self.scales.beat * self.duration / WINDOWS
        settled = settling(self.scales) <= MOST_SETTLING * WINDOW_PERIODS
        one_ratio = len(set(self.scene.signals["frequency_ratio"].values)) == 1
        events = self.varying and "event_times" in self.run_needs
        slow = self.scales.slowness is not None and self.scales.slowness <= MOST_SLOWNESS
        calm = slow and settled and corners <= MOST_CORNERS and beats <= BEATS
        return calm and one_ratio and not events

    @cached_property
    def no_beat(self) -> str:
        """Why there is no beat that a run could show, empty where it is not needed or there is."""
        if "beat" not in self.run_needs:
            return ""
        ratio = self.scene.signals["frequency_ratio"]
        if len(set(ratio.values)) > 1:
            return "the frequency ratio changes, and the beat with it"
        if self.scales.beat == 0.0:
            where = f"no beat at frequency_ratio = {ratio.values[0]:.9g}"
            if self.scales.detuning == 0.0:
                return f"{where}: at an integer the two phases stand still to each other"
            return f"{where}: it is farther than {NEAR_AN_INTEGER:g} from an integer"
        beats = 0.5 * self.duration * self.scales.beat
        if beats < FEWEST_BEATS:
            return f"the later half of the run has {beats:.2g} beats; {FEWEST_BEATS:g} show one"
        return ""

    @cached_property
    def _head(self) -> Stretch:
        stop = self.probed_duration
        points: Array = np.empty(0)
        if SIGNAL_NEEDS & set(self.run_needs):
            points = as_run(self.scene, stop, self.scene.step_size or stop).times
        return Stretch(0.0, stop, looks_between(points, 0.0, stop))

    @cached_property
    def _windows(self) -> Windows:
        return lay_windows(self.instance, self.scene, self.scales, self.duration, self._head.stop)

    def _truth(self, step: float, stretch: Stretch) -> Course:
        """Return the resolved run at the points of a candidate with this step (s)."""
        key = step, stretch.start
        if self.varying and self.covers == "windows":
            key = 0.0, stretch.start
        if key not in self._truths:
            held = self._as_they_vary(step, stretch)
            finest = Candidate(self.truth_model, FINEST_TOLERANCE, step)
            self._truths[key] = self._follow(finest, held, stretch)
        return self._truths[key]

    def _as_run(self, step: float) -> HeldGrid:
        """Return the inputs of the first stretch as a run in this step (s) holds them.

        Where they do not vary other than by jumps, points between these would not change them.
        """
        stop = self._head.stop
        return as_run(self.scene, stop, step if self.varying else stop)

    def _as_they_vary(self, step: float, stretch: Stretch) -> HeldGrid:
        """Return the inputs without an error of holding them, for a candidate with this step (s).

        Within a window a few steps in a drive period serve; else there are some in its own step.
        """
        length, fine = stretch.stop - stretch.start, step / TRUTH_STEPS
        if not self.varying:
            fine = length
        elif self.covers == "windows":
            fine = self.scales.period / WINDOW_STEPS
        while self.varying and length / fine > MOST_POINTS and fine < 0.5 * step:
            fine *= 2.0
        return as_meant(self.scene, stretch.stop, fine, stretch.start)

    def _follow(self, candidate: Candidate, held: HeldGrid, stretch: Stretch) -> Course:
        if candidate.model.fidelity > 0:
            self.drive_periods += (stretch.stop - stretch.start) / self.scales.period
        grid: Array = np.empty(0)
        if "beat" in self.run_needs and stretch.start == 0.0:
            step = candidate.step or self.duration
            steps = int(stretch.stop / step * (1.0 + 1e-9))
            grid = np.minimum(step * np.arange(steps + 1), stretch.stop)
        return follow(self.instance, self.scene, candidate.parameters, held, stretch, grid)
