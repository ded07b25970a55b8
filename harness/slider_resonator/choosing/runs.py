"""Runs of candidates and of the resolved device over the same part of a scene."""

from __future__ import annotations

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.choosing.candidate import Candidate, Model
from slider_resonator.choosing.coverage import FINEST_TOLERANCE, MAX_STEPS, Coverage
from slider_resonator.choosing.input_grid import (
    InputGrid,
    inputs_as_they_vary,
    must_hold,
    sampled_inputs,
)
from slider_resonator.choosing.scales import Scales
from slider_resonator.choosing.stretch import Samples, Stretch, follow
from slider_resonator.fmu.instance import Instance
from slider_resonator.scenes.scene import Scene

REFERENCE_STEPS = 8
"""Steps of the resolved run in one step of a candidate, where inputs vary."""
MIN_POINTS, MAX_POINTS = 4000, 20_000
"""Points of a resolved run, where inputs vary; at least two in a step of the candidate."""
WINDOW_STEPS = 4
"""Steps in a drive period, in windows, that follow inputs as they vary."""


class Runs:
    """Runs of one scene in one FMU instance; resolved ones are kept.

    `drive_periods` counts those of all resolved runs. A run raises FmuError or Refusal where the
    FMU cannot do it.
    """

    def __init__(
        self,
        instance: Instance,
        scene: Scene,
        scales: Scales,
        coverage: Coverage,
        reference_model: Model,
    ) -> None:
        self.drive_periods = 0.0
        self._instance = instance
        self._scene = scene
        self._scales = scales
        self._coverage = coverage
        self._reference_model = reference_model
        self._references: dict[tuple[float, float, float], Samples] = {}

    def sampled(self, candidate: Candidate, step: float, stretch: Stretch) -> Samples:
        """Run a candidate with inputs sampled and held at each step (s)."""
        held = self._sampled_inputs(candidate.model, step, stretch.stop)
        return self._follow(candidate, held, stretch)

    def varying(self, candidate: Candidate, step: float, stretch: Stretch) -> Samples:
        """Run a candidate with this step (s) under inputs as they vary."""
        return self._follow(candidate, self._inputs_as_they_vary(step, stretch), stretch)

    def alike(self, candidate: Candidate, step: float, stretch: Stretch) -> tuple[Samples, Samples]:
        """Run a candidate and the resolved device under the same inputs, as they vary."""
        return self.varying(candidate, step, stretch), self.reference(step, stretch)

    def reference(self, step: float, stretch: Stretch) -> Samples:
        """Return the resolved run at the points of a candidate with this step (s)."""
        alike = self._in_window(stretch) or not self._reference_depends_on_step
        key = 0.0 if alike else step, stretch.start, stretch.stop
        if key not in self._references:
            held = self._inputs_as_they_vary(step, stretch)
            finest = Candidate(self._reference_model, FINEST_TOLERANCE, step)
            self._references[key] = self._follow(finest, held, stretch)
        return self._references[key]

    @property
    def _reference_depends_on_step(self) -> bool:
        """Whether the resolved run depends on the step of the candidate."""
        holds = must_hold(self._scene, interpolates=self._instance.fmu.interpolates)
        return holds or "beat" in self._coverage.run_needs

    def _in_window(self, stretch: Stretch) -> bool:
        """Whether inputs that vary are followed as they do, and not as a candidate holds them."""
        part = stretch.start > 0.0 or stretch.stop < self._coverage.duration
        return self._coverage.varying and self._coverage.part == "windows" and part

    def _sampled_inputs(self, model: Model, step: float, stop: float) -> InputGrid:
        """Return the inputs up to `stop` (s) as a run in this step (s) samples and holds them.

        Where they do not vary other than by jumps, steps that change nothing are left out, and all
        if there are more than `MAX_STEPS`.
        """
        own = self._coverage.varying or not (model.any_step or stop / step > MAX_STEPS)
        return sampled_inputs(self._scene, stop, step if own else stop)

    def _inputs_as_they_vary(self, step: float, stretch: Stretch) -> InputGrid:
        """Return the inputs without an error of holding them, for a candidate with this step (s).

        Within a window a few steps in a drive period serve; else there are some in its own step.
        """
        length = stretch.stop - stretch.start
        fine = min(step / REFERENCE_STEPS, length / MIN_POINTS)
        if not self._coverage.varying:
            fine = length
        elif self._in_window(stretch):
            fine = self._scales.period / WINDOW_STEPS
        while self._coverage.varying and length / fine > MAX_POINTS and fine < 0.5 * step:
            fine *= 2.0
        return inputs_as_they_vary(
            self._scene,
            stretch.stop,
            fine,
            stretch.start,
            interpolates=self._instance.fmu.interpolates,
        )

    def _follow(self, candidate: Candidate, held: InputGrid, stretch: Stretch) -> Samples:
        if candidate.model.fidelity > 0:
            self.drive_periods += (stretch.stop - stretch.start) / self._scales.period
        grid: Array = np.empty(0)
        if "beat" in self._coverage.run_needs and stretch.start == 0.0:
            step = candidate.step or self._coverage.duration
            steps = int(stretch.stop / step * (1.0 + 1e-9))
            grid = np.minimum(step * np.arange(steps + 1), stretch.stop)
        return follow(self._instance, self._scene, candidate.parameters, held, stretch, grid)
