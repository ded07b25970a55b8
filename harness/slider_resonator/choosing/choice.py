"""Candidates, their errors against the allowed ones, and the answer: chosen and ruled out."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import isfinite
from typing import Any

from slider_resonator.device.model import LUGRE, Model
from slider_resonator.output.readable import number_of
from slider_resonator.output.shown import Shown, Tabular
from slider_resonator.scenes.key_table import units_of
from slider_resonator.scenes.needs import NeedTable
from slider_resonator.scenes.scene import Scene

START_TOLERANCE = 1e-8
"""The FMU's start value, answered where the model has no use for a tolerance."""

INPUTS = {
    "interpolated": "straight lines between communication points, by their derivatives",
    "held": "straight lines are held over each step; `run --interpolate`, or interpolate = true in "
    "[run], passes them on",
    "cannot": "straight lines are held over each step: the FMU has canInterpolateInputs = false",
}
"""How inputs that are straight lines reach an FMU, in words."""

PROBES = {
    "whole": "resolved motion of the whole run",
    "leaps": "leaps over the whole run",
    "steady motion": "steady motion",
}
"""What errors are against, in words."""


def uses_tolerance(model: Model) -> bool:
    """Whether a model integrates a bristle or leaps over periods; else its accuracy is its own."""
    return model.leaps or (model.friction_law == LUGRE and model.fidelity > 0)


def tolerances(model: Model) -> tuple[float, ...]:
    """Return the tolerances to choose from, from the cheapest on."""
    if uses_tolerance(model):
        return tuple(10.0**-digits for digits in range(3, 13))
    return (START_TOLERANCE,)


@dataclass(frozen=True)
class Candidate:
    """A model with the tolerance (1) and communication step (s) it is run with.

    `step` is None where nothing is run.
    """

    model: Model
    tolerance: float
    step: float | None

    @property
    def parameters(self) -> dict[str, float]:
        """The FMU parameters that make it."""
        return {**self.model.parameters, "tolerance": self.tolerance}


@dataclass(frozen=True)
class RuledOut(Model):
    """A model that is not the answer, and why."""

    why: str = ""


@dataclass(frozen=True, repr=False)
class Choice(Shown, Tabular):
    """The cheapest candidate that meets every need, or the nearest where `meets` is False.

    `averaging_order` is None but for averaged motion in an FMU that has a choice of orders. `step`
    (s) is None for a scene without a run. `error` is what was measured and `allowed` what is
    needed, by need in its unit (m/s, m, s, N, Hz), None where there is no such thing. `cost` is the
    measured CPU time (s) of a run, with the host's. `probe` says what the errors are against:
    resolved motion over the "whole" scene, "leaps" over it, or "steady motion"; and
    `probe_drive_periods` how much was resolved, in periods of `drive_period` (s).
    `inputs` is how inputs that are straight lines reach the FMU, a key of `INPUTS`, None without
    any. Where inputs have `jumps`, steps end at these, too.
    """

    fidelity: int
    averaging_order: int | None
    friction_law: int
    step: float | None
    tolerance: float
    meets: bool
    error: Mapping[str, float]
    allowed: Mapping[str, float]
    cost: float
    ruled_out: Sequence[RuledOut]
    reason: str
    probe: str
    probe_drive_periods: float
    drive_period: float
    inputs: str | None
    jumps: bool

    @property
    def model(self) -> Model:
        """Fidelity, friction law and averaging order."""
        return Model(self.fidelity, self.friction_law, self.averaging_order)

    @property
    def parameters(self) -> dict[str, float]:
        """The FMU parameters that were chosen."""
        return Candidate(self.model, self.tolerance, self.step).parameters

    def applied_to(self, scene: Scene) -> Scene:
        """Return the scene with what was chosen."""
        chosen = scene.with_values(self.parameters)
        return chosen if self.step is None else chosen.timed(step_size=self.step)

    def sentences(self) -> list[str]:
        """Return what was chosen, without the needs, for people."""
        step = "none, nothing is run"
        if self.step is not None:
            periods = float(f"{self.step / self.drive_period:.4g}")
            step = f"{self.step:.6g} s, {number_of(periods, 'drive period')}"
        step += f", tolerance {self.tolerance:g}" if uses_tolerance(self.model) else ""
        step += f"; inputs: {INPUTS[self.inputs]}" if self.step and self.inputs else ""
        step += "; steps also end where inputs jump" if self.step and self.jumps else ""
        return [
            f"{'chosen' if self.meets else 'nearest':<9}{self.model.name}",
            f"step     {step}",
            f"why      {self.reason}",
            f"cost     {self.cost:.3g} s of CPU time, measured",
            f"probe    against {PROBES[self.probe]}; {self.probe_drive_periods:.0f} drive periods "
            "resolved in all",
        ]

    def table(self) -> dict[str, list[Any]]:
        """Return need, error, allowed error and unit, in columns."""
        units = units_of(NeedTable)
        return {
            "need": list(self.error),
            "error": list(self.error.values()),
            "allowed": [self.allowed[name] for name in self.error],
            "unit": [units[name] for name in self.error],
        }

    def describe(self) -> list[str]:
        """Return what was chosen, how it meets each need, and what was ruled out."""
        lines = self.sentences()
        for name, error, allowed, unit in zip(*self.table().values(), strict=True):
            found = f"{error:.3g}" if isfinite(error) else "no bound"
            lines.append(f"need     {name}: error {found}, allowed {allowed:.3g} {unit}")
        return [*lines, *(f"not      {one.name}: {one.why}" for one in self.ruled_out)]
