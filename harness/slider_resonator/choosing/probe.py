"""The errors of candidates, from runs beside the resolved device over parts of a scene."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import cached_property
from math import inf

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.choosing.beat import lacking_beat, unseen_beat
from slider_resonator.choosing.candidate import START_TOLERANCE, Candidate, Model
from slider_resonator.choosing.carrying import Drift, carried, defect, over_the_scene
from slider_resonator.choosing.cost import AVERAGING_ORDERS
from slider_resonator.choosing.coverage import (
    MAX_STEPS,
    SIGNAL_NEEDS,
    Coverage,
)
from slider_resonator.choosing.errors import ErrorEstimate, Estimates, errors
from slider_resonator.choosing.holding import holding_errors, with_holding
from slider_resonator.choosing.input_grid import (
    sampled_inputs,
)
from slider_resonator.choosing.plan import Plan, plan_of
from slider_resonator.choosing.runs import Runs
from slider_resonator.choosing.scales import scales_of
from slider_resonator.choosing.stretch import Samples, Stretch, checkpoints_between
from slider_resonator.choosing.windows import Windows, lay_windows
from slider_resonator.fmu.instance import Instance
from slider_resonator.scenes.need_table import RUN_NEEDS, STEADY_NEEDS
from slider_resonator.scenes.scene import Scene

HOLDING_STEPS = 500
"""Steps of averaged motion from which the error of holding the inputs follows."""
MAX_FOLLOWED_STEPS = 100_000
"""Steps of a candidate besides a reference that follows lines of inputs, where inputs vary."""
CAUTION = 3.0
"""Safety factor on errors extrapolated from the beginning, besides their growth with time."""


class Probe:
    """One scene in one FMU instance: the errors of its candidates.

    An FMU that takes no derivatives of inputs has them held. `covers` is the part of the scene that
    is resolved: "whole", "windows" or "beginning".
    """

    def __init__(self, instance: Instance, scene: Scene) -> None:
        self.instance = instance
        self.can_interpolate = instance.fmu.interpolates
        self._asks = scene.run is not None and scene.run.interpolate
        self.scene = scene = scene if self.can_interpolate else scene.interpolating(False)
        self.scales = scales_of(scene)
        needs = scene.need.needs if scene.need else {}
        self.run_needs = [name for name in RUN_NEEDS if name in needs]
        self.steady_needs = [name for name in STEADY_NEEDS if name in needs]
        self.duration = scene.stop_time or 0.0
        self.reference_model = Model(2, scene.device.friction_law)
        self.coverage = Coverage(scene, self.scales, self.reference_model, self.run_needs)
        self.varying = self.coverage.varying
        has_orders = "averaging_order" in instance.fmu.variables
        self.averaging_orders = AVERAGING_ORDERS if has_orders else (None,)
        self._averaged = Model(0, scene.device.friction_law, self.averaging_orders[0])
        self._runs = Runs(instance, scene, self.scales, self.coverage, self.reference_model)
        self._extrapolations: dict[Candidate, Estimates] = {}
        self._plans: dict[float, Plan] = {}
        self._holdings: dict[float, dict[str, float]] = {}
        self._final_velocity: float | None = None

    @property
    def covers(self) -> str:
        """The resolved part of the scene: whole, windows or beginning."""
        return self.coverage.part

    @property
    def drive_periods(self) -> float:
        """Drive periods that the FMU has resolved so far."""
        return self._runs.drive_periods

    @property
    def max_steps(self) -> int:
        """Largest number of steps that are tried, where inputs vary.

        An FMU that follows their lines has a reference that needs no steps of its own.
        """
        return MAX_FOLLOWED_STEPS if self.can_interpolate else MAX_STEPS

    @property
    def probed_duration(self) -> float:
        """Length (s) of the longest stretch that is resolved."""
        return self.coverage.longest

    def plan(self, step: float) -> Plan:
        """Return what a run in this step (s) asks of the FMU."""
        if step not in self._plans:
            self._plans[step] = plan_of(self.scene.with_step(step).schedule(), self.scales.period)
        return self._plans[step]

    @property
    def inputs(self) -> str | None:
        """How inputs that are straight lines reach the FMU, as `Choice` says; None without any."""
        if self.scene.run is None or not self.scene.interpolating(True).interpolates:
            return None
        if self.scene.run.interpolate:
            return "interpolated"
        return "cannot" if self._asks else "held"

    def resolve(self, step: float) -> None:
        """Run the resolved device as for a candidate with this step (s).

        Raises FmuError or Refusal where the FMU cannot: then there is no reference.
        """
        self._runs.reference(step, self._head)

    def run_errors(self, candidate: Candidate) -> Estimates:
        """Return the errors of a run with the candidate, as estimated by the probe.

        Raises FmuError or Refusal where the FMU cannot run it.
        """
        step = candidate.step or self.duration
        if self.covers == "windows":
            return with_holding(self._extrapolated(candidate, step), self._holding(step))
        seen = self._compared(candidate, step, self._head)
        return seen if self.covers == "whole" else self._grown(candidate, seen)

    @property
    def can_be_confirmed(self) -> bool:
        """Whether errors that windows give can be had from the whole scene, too."""
        return self.covers == "windows" and self.coverage.can_be_whole

    def confirmed_errors(self, candidate: Candidate) -> Estimates:
        """Return the errors of a run of the whole scene with the candidate.

        Raises FmuError or Refusal where the FMU cannot run it.
        """
        return self._compared(candidate, candidate.step or self.duration, self._whole)

    def _compared(self, candidate: Candidate, step: float, stretch: Stretch) -> Estimates:
        samples = self._runs.sampled(candidate, step, stretch)
        return self._seen(samples, self._runs.reference(step, stretch))

    def _seen(self, samples: Samples, reference: Samples) -> Estimates:
        law = self.reference_model.friction_law
        seen = errors(self.run_needs, samples, reference, self.scales.period, law)
        if "beat" not in seen:
            return seen
        why = self.no_beat or unseen_beat(seen["beat"], self.scales)
        return {**seen, "beat": ErrorEstimate(inf, 0.0, why)} if why else seen

    def _extrapolated(self, candidate: Candidate, step: float) -> Estimates:
        """Return the errors of a candidate with inputs as they vary, from head and windows."""
        key = replace(candidate, step=None if self.varying else step)
        if key not in self._extrapolations:
            head, reference = self._runs.alike(candidate, step, self._head)
            drift, velocity = self._drift(candidate, step)
            sizes, seen = self._sizes(step), self._seen(head, reference)
            self._extrapolations[key] = over_the_scene(drift, velocity, sizes, seen)
        return self._extrapolations[key]

    def _drift(self, candidate: Candidate, step: float) -> tuple[Drift, float]:
        """Return the drift of a candidate at the end of the scene, its largest velocity error."""
        head, reference = self._runs.alike(candidate, step, self._head)
        u, x = (
            float(head[name][-1] - reference[name][-1]) for name in ("mean_velocity", "position")
        )
        defects = [
            defect(window, *self._runs.alike(candidate, step, window.stretch), self.scales.period)
            for window in self._windows.windows
        ]
        return carried(defects, u, x, self._head.stop)

    def _sizes(self, step: float) -> Mapping[str, float]:
        """Return the sizes of the needed quantities, the mean velocity without averaging's error.

        A mean velocity near zero would else count as what averaged motion happens to leave.
        """
        if self._final_velocity is None:
            drift, _ = self._drift(Candidate(self._averaged, START_TOLERANCE, step), step)
            self._final_velocity = abs(self._windows.final_velocity - drift.velocity)
        return {**self._windows.sizes, "mean_velocity": self._final_velocity}

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
                self.instance, self.scene, self._averaged, self.duration, coarse
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

    @cached_property
    def no_beat(self) -> str:
        """The reason why a run shows no beat; empty where it shows one or none is needed."""
        return lacking_beat(self.scene, self.scales) if "beat" in self.run_needs else ""

    @cached_property
    def _head(self) -> Stretch:
        return self._beginning(self.probed_duration)

    @cached_property
    def _whole(self) -> Stretch:
        return self._beginning(self.duration)

    def _beginning(self, stop: float) -> Stretch:
        points: Array = np.empty(0)
        if SIGNAL_NEEDS & set(self.run_needs):
            points = sampled_inputs(self.scene, stop, self.scene.step_size or stop).times
        return Stretch(0.0, stop, checkpoints_between(points, 0.0, stop))

    @cached_property
    def _windows(self) -> Windows:
        return lay_windows(self.instance, self.scene, self._averaged, self.scales, self._head.stop)
