"""The answer: the chosen candidate, its predicted errors, and the models ruled out."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from slider_resonator.scenes.scene import Scene
from slider_resonator.studies.choose.candidate import Candidate, Model
from slider_resonator.studies.choose.scales import Scales


@dataclass(frozen=True)
class RuledOut:
    """A model that is not the answer, and why."""

    fidelity: int
    friction_law: int
    why: str


@dataclass(frozen=True)
class Choice:
    """The cheapest candidate that meets every need, or the nearest where `meets` is False.

    `step` (s) is None for a scene without a run. `error` is what is predicted and `allowed` what is
    needed, by need in its unit (m/s, m, s, N, Hz), None where there is no such thing. `cost` is in
    seconds of CPU time by the model in `slider_resonator.studies.choose.cost`. `probe` says what
    was resolved to confirm it: "whole" scene, "windows" or "beginning", and `probe_drive_periods`
    how much.
    """

    fidelity: int
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
    scales: Scales

    @property
    def model(self) -> Model:
        """Fidelity and friction law."""
        return Model(self.fidelity, self.friction_law)

    @property
    def parameters(self) -> dict[str, float]:
        """The FMU parameters that were chosen."""
        return Candidate(self.model, self.tolerance, self.step).parameters

    def applied_to(self, scene: Scene) -> Scene:
        """Return the scene with what was chosen."""
        chosen = scene.with_values(self.parameters)
        return chosen if self.step is None else chosen.with_step(self.step)

    def sentences(self) -> list[str]:
        """Return what was chosen, without the needs, for people."""
        return [
            f"{'chosen' if self.meets else 'nearest':<9}{self.model.name}",
            f"step     {self._step}",
            f"why      {self.reason}",
            f"cost     {self.cost:.3g} s of CPU time, by counts of steps and periods",
            f"probe    {self.probe_drive_periods:.0f} drive periods resolved ({self.probe})",
        ]

    @property
    def _step(self) -> str:
        tolerance = f", tolerance {self.tolerance:g}" if self.model.uses_tolerance else ""
        if self.step is None:
            return f"none, nothing is run{tolerance}"
        periods = self.step / self.scales.period
        return f"{self.step:.6g} s, {periods:.4g} drive periods{tolerance}"
