"""The resolved probe: a candidate and the resolved device over the same part of a scene."""

from __future__ import annotations

from dataclasses import replace
from functools import cached_property
from math import inf

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.device.interface import INPUTS
from slider_resonator.fmu.instance import Instance
from slider_resonator.scenes.scene import Scene
from slider_resonator.scenes.schema import RUN_NEEDS, STEADY_NEEDS
from slider_resonator.studies.choose.candidate import Candidate, Model
from slider_resonator.studies.choose.cost import period_cost
from slider_resonator.studies.choose.errors import ErrorEstimate, Estimates, errors
from slider_resonator.studies.choose.held_grid import (
    HeldGrid,
    averaged_inputs,
    sampled_inputs,
    vary,
)
from slider_resonator.studies.choose.scales import NEAR_AN_INTEGER, scales_of
from slider_resonator.studies.choose.stretch import Samples, Stretch, checkpoints_between, follow
from slider_resonator.studies.choose.windows import (
    MAX_SETTLING,
    WINDOW_PERIODS,
    WINDOWS,
    Windows,
    defect,
    extrapolated,
    holding_errors,
    lay_windows,
    settling,
    with_holding,
)

FINEST_TOLERANCE = 1e-13
"""Tolerance of the resolved LuGre device, the reference of all candidates."""
REFERENCE_STEPS = 8
"""Steps of the resolved run in one step of a candidate, where inputs vary."""
MAX_POINTS = 20_000
"""Points of a resolved run, where inputs vary; at least two in a step of the candidate."""
HOLDING_STEPS = 500
"""Steps of averaged motion from which the error of holding the inputs follows."""
WINDOW_STEPS = 4
"""Steps in a drive period, in windows, that follow inputs as they vary."""
MAX_STEPS = 10_000
"""Steps of a candidate in the probe, where inputs vary."""
SHORT, LONG = 3000.0, 30_000.0
"""Drive periods up to which a scene is always, and up to which it can be, resolved as a whole."""
HEAD_PERIODS, MIN_PERIODS = 1000.0, 100.0
"""Drive periods that are resolved at the beginning of a longer scene."""
CHEAP_PERIOD = 3e-6
"""Cost (s) of a drive period up to which these numbers hold; more expensive ones are fewer."""
CAUTION = 3.0
"""Safety factor on errors extrapolated from the beginning, besides their growth with time."""
MAX_SLOWNESS = 0.05
"""Largest friction over vibration at which averaged motion is used between windows."""
MAX_CORNERS = 2 * WINDOWS
"""Largest number of corners of the inputs for which windows suffice."""
BEATS = 0.25
"""Largest number of beats between two windows for which windows suffice."""
MIN_BEATS = 2.0
"""Beats in the later half of a run from which their frequency can be read."""
SIGNAL_NEEDS = frozenset({"position", "velocity", "event_times"})
"""Needs that are judged at every step of the scene, not at its end only."""


class Probe:
    """One scene in one FMU instance: the errors of its candidates.

    `covers` is the part of the scene that is resolved: "whole", "windows" or "beginning".
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
        self.reference_model = Model(2, scene.device.friction_law)
        self.drive_periods = 0.0
        self._references: dict[tuple[float, float], Samples] = {}
        self._extrapolations: dict[Candidate, Estimates] = {}
        self._holdings: dict[float, dict[str, float]] = {}

    @cached_property
    def covers(self) -> str:
        """The resolved part of the scene: whole, windows or beginning."""
        periods = self._weight * self.duration / self.scales.period
        points = self.duration / (self.scene.step_size or inf) if self._steps_often else 0.0
        if periods <= SHORT and points <= MAX_STEPS:
            return "whole"
        if self._shows_in_windows():
            return "windows"
        return "whole" if periods <= LONG and points <= MAX_STEPS else "beginning"

    @property
    def probed_duration(self) -> float:
        """Length (s) of the longest stretch that is resolved."""
        if self.covers == "whole":
            return self.duration
        periods = max(MIN_PERIODS, HEAD_PERIODS / self._weight)
        return min(periods * self.scales.period, self.duration)

    @property
    def _weight(self) -> float:
        """Cost of a resolved drive period, in drive periods of a cheap device."""
        cost = period_cost(self.reference_model, FINEST_TOLERANCE, self.scales)
        return max(1.0, cost / CHEAP_PERIOD)

    @property
    def _steps_often(self) -> bool:
        """Whether the candidate must take every step of the scene, as inputs vary."""
        return self.varying and bool(SIGNAL_NEEDS & set(self.run_needs))

    def resolve(self, step: float) -> None:
        """Run the resolved device as for a candidate with this step (s).

        Raises FmuError or Refusal where the FMU cannot: then there is no reference.
        """
        self._reference(step, self._head)

    def run_errors(self, candidate: Candidate) -> Estimates:
        """Return the errors of a run with the candidate, as estimated by the probe.

        Raises FmuError or Refusal where the FMU cannot run it.
        """
        step = candidate.step or self.duration
        if self.covers == "windows":
            return with_holding(self._extrapolated(candidate, step), self._holding(step))
        samples = self._follow(candidate, self._sampled_inputs(step), self._head)
        seen = self._seen(samples, self._reference(step, self._head))
        return seen if self.covers == "whole" else self._grown(candidate, seen)

    def _seen(self, samples: Samples, reference: Samples) -> Estimates:
        law = self.reference_model.friction_law
        seen = errors(self.run_needs, samples, reference, self.scales.period, law)
        return {**seen, "beat": ErrorEstimate(inf, 0.0, self.no_beat)} if self.no_beat else seen

    def _extrapolated(self, candidate: Candidate, step: float) -> Estimates:
        """Return the errors of a candidate with inputs as they vary, from head and windows."""
        key = replace(candidate, step=None if self.varying else step)
        if key not in self._extrapolations:
            head, reference = self._alike(candidate, step, self._head)
            defects = [
                defect(window, *self._alike(candidate, step, window.stretch), self.scales)
                for window in self._windows.windows
            ]
            seen, sizes = self._seen(head, reference), self._windows.sizes
            self._extrapolations[key] = extrapolated(
                defects, sizes, head, reference, seen, self.duration
            )
        return self._extrapolations[key]

    def _alike(
        self, candidate: Candidate, step: float, stretch: Stretch
    ) -> tuple[Samples, Samples]:
        """Return candidate and resolved device under the same inputs."""
        held = self._averaged_inputs(step, stretch)
        return self._follow(candidate, held, stretch), self._reference(step, stretch)

    def _holding(self, step: float) -> dict[str, float]:
        """Return the errors that come from holding the inputs over a step (s).

        They hardly depend on the model and are of first order in the step, so that averaged motion
        in coarse steps gives them.
        """
        if not self.varying:
            return {}
        coarse = max(step, self.duration / HOLDING_STEPS)
        if coarse not in self._holdings:
            self._holdings[coarse] = holding_errors(
                self.instance, self.scene, self.duration, coarse
            )
        return {name: error * step / coarse for name, error in self._holdings[coarse].items()}

    def _grown(self, candidate: Candidate, seen: Estimates) -> Estimates:
        """Return the errors of the resolved model itself, extrapolated to the end of the scene."""
        if candidate.model != self.reference_model:
            reason = "the scene is too long, with too many changes of inputs, for a short probe"
            return {name: replace(e, error=inf, reason=reason) for name, e in seen.items()}
        growth = CAUTION * self.duration / self.probed_duration
        return {
            name: estimate if name == "beat" else replace(estimate, error=growth * estimate.error)
            for name, estimate in seen.items()
        }

    def _shows_in_windows(self) -> bool:
        """Whether windows represent the whole scene."""
        signals = [self.scene.signals[name] for name in INPUTS]
        corners = sum(0.0 < time < self.duration for s in signals for time in s.times)
        beats = self.scales.beat * self.duration / WINDOWS
        settled = settling(self.scales) <= MAX_SETTLING * WINDOW_PERIODS
        one_ratio = len(set(self.scene.signals["frequency_ratio"].values)) == 1
        events = self.varying and "event_times" in self.run_needs
        slow = self.scales.slowness is not None and self.scales.slowness <= MAX_SLOWNESS
        calm = slow and settled and corners <= MAX_CORNERS and beats <= BEATS
        return calm and one_ratio and not events

    @cached_property
    def no_beat(self) -> str:
        """The reason why a run shows no beat; empty where it shows one or none is needed."""
        if "beat" not in self.run_needs:
            return ""
        ratio = self.scene.signals["frequency_ratio"]
        if len(set(ratio.values)) > 1:
            return "the frequency ratio changes, and the beat with it"
        if self.scales.beat == 0.0:
            where = f"no beat at frequency_ratio = {ratio.values[0]:.9g}"
            if self.scales.detuning == 0.0:
                return f"{where}: at an integer the difference of the two phases is constant"
            return f"{where}: it is farther than {NEAR_AN_INTEGER:g} from an integer"
        beats = 0.5 * self.duration * self.scales.beat
        if beats < MIN_BEATS:
            return f"the later half of the run has {beats:.2g} beats; {MIN_BEATS:g} show one"
        return ""

    @cached_property
    def _head(self) -> Stretch:
        stop = self.probed_duration
        points: Array = np.empty(0)
        if SIGNAL_NEEDS & set(self.run_needs):
            points = sampled_inputs(self.scene, stop, self.scene.step_size or stop).times
        return Stretch(0.0, stop, checkpoints_between(points, 0.0, stop))

    @cached_property
    def _windows(self) -> Windows:
        return lay_windows(self.instance, self.scene, self.scales, self.duration, self._head.stop)

    def _reference(self, step: float, stretch: Stretch) -> Samples:
        """Return the resolved run at the points of a candidate with this step (s)."""
        key = step, stretch.start
        if self.varying and self.covers == "windows":
            key = 0.0, stretch.start
        if key not in self._references:
            held = self._averaged_inputs(step, stretch)
            finest = Candidate(self.reference_model, FINEST_TOLERANCE, step)
            self._references[key] = self._follow(finest, held, stretch)
        return self._references[key]

    def _sampled_inputs(self, step: float) -> HeldGrid:
        """Return the inputs of the first stretch as a run in this step (s) holds them.

        Where they do not vary other than by jumps, points between these would not change them.
        """
        stop = self._head.stop
        return sampled_inputs(self.scene, stop, step if self.varying else stop)

    def _averaged_inputs(self, step: float, stretch: Stretch) -> HeldGrid:
        """Return the inputs without an error of holding them, for a candidate with this step (s).

        Within a window a few steps in a drive period serve; else there are some in its own step.
        """
        length, fine = stretch.stop - stretch.start, step / REFERENCE_STEPS
        if not self.varying:
            fine = length
        elif self.covers == "windows":
            fine = self.scales.period / WINDOW_STEPS
        while self.varying and length / fine > MAX_POINTS and fine < 0.5 * step:
            fine *= 2.0
        return averaged_inputs(self.scene, stretch.stop, fine, stretch.start)

    def _follow(self, candidate: Candidate, held: HeldGrid, stretch: Stretch) -> Samples:
        if candidate.model.fidelity > 0:
            self.drive_periods += (stretch.stop - stretch.start) / self.scales.period
        grid: Array = np.empty(0)
        if "beat" in self.run_needs and stretch.start == 0.0:
            step = candidate.step or self.duration
            steps = int(stretch.stop / step * (1.0 + 1e-9))
            grid = np.minimum(step * np.arange(steps + 1), stretch.stop)
        return follow(self.instance, self.scene, candidate.parameters, held, stretch, grid)
