"""Choose the cheapest model for a scene: by error estimates, confirmed by a short resolved run."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from math import inf
from pathlib import Path

from slider_resonator.choosing.candidate import (
    COULOMB,
    LUGRE,
    START_TOLERANCE,
    Candidate,
    Model,
    models,
)
from slider_resonator.choosing.choice import Choice, Evaluation, RuledOut
from slider_resonator.choosing.cost import run_cost, search_cost
from slider_resonator.choosing.coverage import FINEST_TOLERANCE
from slider_resonator.choosing.errors import Estimates
from slider_resonator.choosing.ladder import step_ladder
from slider_resonator.choosing.probe import Probe
from slider_resonator.choosing.scales import check_magnitudes
from slider_resonator.choosing.search import coarsest
from slider_resonator.choosing.steady_need import SteadyValue, find, steady_error
from slider_resonator.errors import FmuError, SceneError
from slider_resonator.fmu.instance import Instance
from slider_resonator.fmu.isolation.process import IsolatedFmu
from slider_resonator.output.progress import Progress, counted, no_progress
from slider_resonator.scenes.scene import Scene

HOPELESS = 1000.0
"""Ratio of predicted to allowed averaging error above which no probe is needed."""
FIRST_TOLERANCE = 1e-6
"""Tolerance at which communication steps are judged and the search for a tolerance starts."""
DOUBTFUL = (0.1, 10.0)
"""Errors over allowed ones, from windows, that the whole scene must confirm."""
ROUNDING = 1e-9
"""Share of a step that is rounding."""
MIN_PERIODS = 30
"""Drive periods of a search by shooting that few searches fall below."""
TIME_LIMIT = 600.0
"""Default time limit of a choice, s."""


def choose(
    scene: Scene,
    fmu: str | Path,
    time_limit: float = TIME_LIMIT,
    progress: Progress = no_progress,
) -> Choice:
    """Return the cheapest model, tolerance and communication step that the scene's needs allow.

    `fmu` is where it is tried, in a process of its own that may take `time_limit` (s). `progress`
    gets the number of the model at work and the share of the models that are judged. Raises
    SceneError for a scene without needs and FmuError or Refusal where the FMU cannot run the
    resolved device.
    """
    with IsolatedFmu(Path(fmu), time_limit) as isolated:
        choice: Choice = isolated.run(partial(choose_with, scene=scene), progress)
        return choice


def choose_with(instance: Instance, scene: Scene, progress: Progress = no_progress) -> Choice:
    """Choose as `choose` does, in an existing instance."""
    progress("resolved run", 0.0)
    return _Choosing(instance, scene).answer(progress)


def candidates(instance: Instance, scene: Scene) -> tuple[tuple[Candidate, float], ...]:
    """Return all that `choose_with` chooses from, with the cost, the cheapest first.

    The cost (s) of a search by shooting is not in it. Raises SceneError for a scene without needs.
    """
    choosing = _Choosing(instance, scene)
    found = [
        Candidate(model, tolerance, step)
        for model in choosing.models()
        for tolerance in model.tolerances
        for step in choosing.ladder
    ]
    costs = ((candidate, choosing.cost(candidate, 0)) for candidate in found)
    return tuple(sorted(costs, key=lambda pair: pair[1]))


class _Choosing:
    """The choice for one scene; SceneError where it has no needs."""

    def __init__(self, instance: Instance, scene: Scene) -> None:
        if scene.need is None:
            raise SceneError(
                f"{scene.source}: scene {scene.name} has no [need]; must have a table of what it "
                "needs, such as mean_velocity = { rel = 0.01 }"
            )
        check_magnitudes(scene)
        self.instance = instance
        self.needs = scene.need.needs
        self.probe = Probe(instance, scene)
        self.scene = self.probe.scene
        self.scales = self.probe.scales
        self.ladder: tuple[float | None, ...] = (None,)
        if self.probe.run_needs:
            self.ladder = step_ladder(self.probe)
        self.law = scene.device.friction_law
        self.periods = 0
        self._evaluations: dict[Candidate, Evaluation] = {}
        self._steady: dict[tuple[str, Candidate], SteadyValue] = {}

    def answer(self, progress: Progress) -> Choice:
        """Try the models from the cheapest on."""
        if impossible := self._impossible():
            self._evaluate(Candidate(self.probe.reference_model, START_TOLERANCE, self.ladder[0]))
            return self._choice(None, [_ruled_out(model, impossible) for model in self.models()])
        if self.ladder[0] is not None:
            self.probe.resolve(self.ladder[0])
        ruled_out: list[RuledOut] = []
        best: Evaluation | None = None
        by_cost = sorted(self.models(), key=self._min_cost)
        for index, model in enumerate(by_cost):
            progress(counted(model.name, index, len(by_cost)), index / len(by_cost))
            why = self._excluded(model)
            if why is None and best is not None and self._min_cost(model) >= best.cost:
                why = f"costs at least {self._min_cost(model):.3g} s, the chosen {best.cost:.3g} s"
            found: Evaluation | None = None
            if why is None:
                found, why = self._cheapest_of(model)
            if found is None:
                ruled_out.append(_ruled_out(model, why))
            elif best is None:
                best = found
            else:
                best, other = sorted((best, found), key=lambda one: one.cost)
                ruled_out.append(_more_expensive(other, best))
        return self._choice(best, ruled_out)

    def _impossible(self) -> str:
        """Return why the resolved device itself lacks a needed quantity, empty if it does not."""
        if self.probe.no_beat:
            return f"beat: {self.probe.no_beat}"
        finest = Candidate(self.probe.reference_model, FINEST_TOLERANCE, None)
        for name in self.probe.steady_needs:
            found = self._find(name, finest)
            if found.value is None:
                return f"{name}: {found.reason}"
        return ""

    def models(self) -> list[Model]:
        """Return the models that the scene allows."""
        free = self.scene.need is not None and self.scene.need.friction_law == "free"
        laws = (COULOMB, LUGRE) if free and self.law == LUGRE else (self.law,)
        return models(laws, self.probe.averaging_orders)

    def _excluded(self, model: Model) -> str | None:
        """Return the reason against a model that needs no probe, None where it needs one."""
        if model.fidelity > 0:
            return None
        if "event_times" in self.needs:
            return "averaged motion has no events"
        if model.averaging_order == 2:
            if self.scales.has_slow_motion or not self.scene.stop_time:
                return None  # predictions need no slow motion
            return "no motion is slow against the resonator: there is nothing to leap over"
        error = self.scales.averaging_error or 0.0
        for name in ("mean_velocity", "velocity") if self.law == COULOMB else ():
            need = self.needs.get(name)
            if need and need.rel is None and error > HOPELESS * (need.abs or inf):
                return f"{name}: {self._law_of(model)}, must be at most {need.abs:.2g} m/s"
        return None

    def _law_of(self, model: Model) -> str:
        """Return the error estimates of a model by theory, empty without any."""
        scales = self.scales
        if model.friction_law != self.law and scales.kappa:
            share = scales.bristle_share
            return f"the bristle bends for a share of about {share:.1g} of the time"
        if model.averaging_order == 2:
            return ""
        if model.fidelity == 0 and scales.averaging_error is not None:
            return f"averaging errs by the order of {scales.averaging_error:.1g} m/s"
        if model.fidelity == 1:
            return (
                f"the resonator starts from rest and remembers {scales.memory:.2g} drive periods, "
                f"r_m is {scales.mass_ratio:.2g}"
            )
        return ""

    def _min_cost(self, model: Model) -> float:
        return self.cost(Candidate(model, model.tolerances[0], self.ladder[0]), MIN_PERIODS)

    def cost(self, candidate: Candidate, periods: int) -> float:
        """Return the cost of the run and of searches over that number of drive periods."""
        cost = 0.0
        if candidate.step is not None:
            cost += run_cost(candidate, self.scales, self.probe.plan(candidate.step))
        if self.probe.steady_needs:
            cost += search_cost(candidate.model, candidate.tolerance, periods, self.scales)
        return cost

    def _cheapest_of(self, model: Model) -> tuple[Evaluation | None, str]:
        """Return the cheapest candidate of a model that meets all needs, or why none does."""
        tolerances = model.tolerances
        first = tolerances.index(FIRST_TOLERANCE) if FIRST_TOLERANCE in tolerances else 0
        refused = ""

        def excess(tolerance: float, step: float | None) -> float:
            nonlocal refused
            try:
                return self._evaluate(Candidate(model, tolerance, step)).excess
            except FmuError as error:
                refused = str(error)
                return inf

        tight = tolerances[-1]
        own = self._own_step() if self.probe.varying else 0
        at = coarsest(lambda i: excess(tight, self.ladder[i]), len(self.ladder), 2.0, fine=own)
        if at is None:
            return None, self._why_not(model, refused)
        if self.probe.covers == "whole":  # errors that change sign may vanish at a coarser step
            at = next(i for i in range(at + 1) if excess(tight, self.ladder[i]) <= 1.0)
        step = self.ladder[at]
        index = coarsest(lambda i: excess(tolerances[i], step), len(tolerances), 10.0, first)
        if index is None:
            return None, self._why_not(model, refused)
        rest = tolerances[index:] if self.probe.steady_needs else tolerances[index : index + 1]
        found = [Candidate(model, one, step) for one in rest if excess(one, step) <= 1.0]
        return min(map(self._evaluate, found), key=lambda one: one.cost), ""

    def _own_step(self) -> int:
        """Return the index of the scene's own step, 0 without one."""
        own = (self.scene.step_size or 0.0) * (1.0 + ROUNDING)
        return next((i for i, step in enumerate(self.ladder) if step and step <= own), 0)

    def _why_not(self, model: Model, refused: str) -> str:
        if all(candidate.model != model for candidate in self._evaluations):
            return refused
        return "; ".join(filter(None, (self._nearest(model).why, self._law_of(model))))

    def _nearest(self, model: Model | None = None) -> Evaluation:
        """Return the evaluation nearest to the needs, of all or a model; the finest of equals."""
        found = [t for t in self._evaluations.values() if model in (None, t.candidate.model)]
        return min(found, key=lambda t: (t.excess, -t.candidate.model.fidelity))

    def _evaluate(self, candidate: Candidate) -> Evaluation:
        if candidate not in self._evaluations:
            estimates: Estimates = {}
            periods = 0
            if self.probe.run_needs:
                estimates |= self.probe.run_errors(candidate)
            for name in self.probe.steady_needs:
                found = self._find(name, candidate)
                finest = Candidate(self.probe.reference_model, FINEST_TOLERANCE, None)
                estimates[name] = steady_error(found, self._find(name, finest), self.law)
                periods += found.periods
            cost = self.cost(candidate, periods)
            covers = self.probe.covers if self.probe.run_needs else "steady motion"
            evaluation = self._evaluated(candidate, estimates, cost, covers)
            if self.probe.can_be_confirmed and DOUBTFUL[0] < evaluation.excess < DOUBTFUL[1]:
                estimates |= self.probe.confirmed_errors(candidate)
                evaluation = self._evaluated(candidate, estimates, cost, "whole")
            self._evaluations[candidate] = evaluation
        return self._evaluations[candidate]

    def _evaluated(
        self, candidate: Candidate, estimates: Estimates, cost: float, covers: str
    ) -> Evaluation:
        allowed = {name: self.needs[name].at(estimates[name].magnitude) for name in estimates}
        return Evaluation(candidate, dict(estimates), allowed, cost, covers)

    def _find(self, name: str, candidate: Candidate) -> SteadyValue:
        key = name, replace(candidate, step=None)
        if key not in self._steady:
            self._steady[key] = find(self.instance, self.scene.values, name, candidate)
            self.periods += self._steady[key].periods
        return self._steady[key]

    def _choice(self, best: Evaluation | None, ruled_out: list[RuledOut]) -> Choice:
        evaluation = best or self._nearest()
        model = evaluation.candidate.model
        none = f"none suffices: {evaluation.why}"
        return Choice(
            fidelity=model.fidelity,
            averaging_order=model.averaging_order,
            friction_law=model.friction_law,
            step=evaluation.candidate.step,
            tolerance=evaluation.candidate.tolerance,
            meets=best is not None,
            error={name: estimate.error for name, estimate in evaluation.estimates.items()},
            allowed=evaluation.allowed,
            cost=evaluation.cost,
            ruled_out=tuple(ruled_out),
            reason="the cheapest that meets every need" if best else none,
            probe=evaluation.probe,
            probe_drive_periods=self.probe.drive_periods + self.periods,
            scales=self.scales,
            inputs=self.probe.inputs,
        )


def _more_expensive(evaluation: Evaluation, best: Evaluation) -> RuledOut:
    why = f"meets the needs too, at {evaluation.cost:.3g} s instead of {best.cost:.3g} s"
    return _ruled_out(evaluation.candidate.model, why)


def _ruled_out(model: Model, why: str) -> RuledOut:
    return RuledOut(model.fidelity, model.friction_law, why, model.averaging_order)
