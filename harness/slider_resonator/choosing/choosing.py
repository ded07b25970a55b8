"""Choose the cheapest model for a scene: by the errors and the cost of its runs."""

import time
from bisect import bisect_left
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from math import inf, isfinite
from pathlib import Path

from slider_resonator.checks.measures import share_of
from slider_resonator.choosing.choice import (
    START_TOLERANCE,
    Candidate,
    Choice,
    RuledOut,
    tolerances,
)
from slider_resonator.choosing.errors import ErrorEstimate, Estimates
from slider_resonator.choosing.probe import HEAD_PERIODS, MAX_PERIODS, Probe, find, steady_error
from slider_resonator.device.model import COULOMB, LUGRE, Model
from slider_resonator.errors import FmuError, SceneError
from slider_resonator.fmu.instance import Instance
from slider_resonator.fmu.isolation.process import IsolatedFmu
from slider_resonator.output.progress import Progress, counted, no_progress
from slider_resonator.scenes.scene import Scene
from slider_resonator.steady.searches import SteadyAnswer

MARGIN = 0.99
"""Largest share of an allowed error that an estimate may take."""
SAME_COST = 1.05
"""Quotient of two costs that counts as a tie: measured times scatter."""
ROUNDING = 1e-9
"""Share of a step that is rounding."""
ROUNDS = 25
"""Times that candidates are timed in turn, at most."""
TIME_LIMIT = 600.0
"""Default time limit of a choice, s."""


@dataclass(frozen=True)
class Evaluation:
    """A candidate with its errors, the allowed ones, and its cost (s)."""

    candidate: Candidate
    estimates: Mapping[str, ErrorEstimate]
    allowed: Mapping[str, float]
    cost: float

    @property
    def excess(self) -> float:
        """The largest error over the allowed one, with the margin."""
        return self._share(self.worst) / MARGIN

    @property
    def worst(self) -> str:
        """The need that is farthest from being met."""
        return max(self.estimates, key=self._share)

    @property
    def why(self) -> str:
        """The worst error in words."""
        estimate, allowed = self.estimates[self.worst], self.allowed[self.worst]
        if isfinite(estimate.error):
            return f"{self.worst} is off by {estimate.error:.3g}, must be at most {allowed:.3g}"
        return f"{self.worst}: {estimate.reason}"

    def _share(self, name: str) -> float:
        return share_of(self.estimates[name].error, self.allowed[name])


def cheapest(evaluations: Sequence[Evaluation]) -> Evaluation:
    """Return the cheapest, and of a tie the one that leaves out least.

    That is resolved motion before leaps, these before fidelity 1 and that before averages, LuGre
    friction before Coulomb's, and the largest tolerance.
    """
    most = SAME_COST * min(one.cost for one in evaluations)

    def rank(one: Evaluation) -> tuple[float, int, float]:
        model = one.candidate.model
        kept = 1.5 if model.leaps else model.fidelity
        return -kept, -model.friction_law, -one.candidate.tolerance

    return min((one for one in evaluations if one.cost <= most), key=rank)


def choose(
    scene: Scene, fmu: str | Path, time_limit: float = TIME_LIMIT, progress: Progress = no_progress
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
    """Choose as `choose` does, in an existing instance, which is created anew for each run."""
    progress("resolved run", 0.0)
    return Choosing(instance, scene).answer(progress)


class Choosing:
    """The choice for one scene; SceneError where it has no needs."""

    def __init__(self, instance: Instance, scene: Scene) -> None:
        if scene.need is None:
            raise SceneError(
                f"{scene.source}: scene {scene.name} has no [need]; must have a table of what it "
                "needs, such as mean_velocity = { rel = 0.01 }, as the scene feed_forward has; "
                "`slider-resonator choose --need` says it, too"
            )
        self.instance = instance
        self.needs = scene.need.needs
        self.free = scene.need.friction_law == "free"
        self.law = scene.device.friction_law
        self.probe = Probe(instance, scene)
        self.scene = self.probe.scene
        self._evaluations: dict[Candidate, Evaluation] = {}
        self._steady: dict[tuple[str, Candidate], SteadyAnswer] = {}

    def answer(self, progress: Progress) -> Choice:
        """Try the models, the simplest first, and time those that serve in turn."""
        if impossible := self._impossible():
            model = self.probe.reference_model
            self._evaluate(Candidate(model, START_TOLERANCE, self.steps(model)[0]))
            return self._choice(None, dict.fromkeys(self.models(), impossible))
        if self.probe.run_needs:
            self.probe.reference(self.probe.ladder[0] or self.probe.duration)
        ruled_out: dict[Model, str] = {}
        good: list[Evaluation] = []
        every = self.models()
        for index, model in enumerate(every):
            progress(counted(model.name, index, len(every)), index / len(every))
            found = self._suitable(model, min(good, key=lambda one: one.cost, default=None))
            if isinstance(found, str):
                ruled_out[model] = found
            else:
                good += found
        if not self._evaluations:
            raise FmuError(ruled_out[self.probe.reference_model])
        if not good:
            return self._choice(None, ruled_out)
        good = self._timed_again(good)
        for one in sorted(good, key=lambda one: -one.cost):
            ruled_out[one.candidate.model] = f"meets the needs too, at {one.cost:.3g} s"
        return self._choice(cheapest(good), ruled_out)

    def _impossible(self) -> str:
        """Return why the resolved device itself lacks a needed quantity, empty if it does not."""
        if self.probe.no_beat:
            return f"beat: {self.probe.no_beat}"
        for name in self.probe.steady_needs:
            found = self._find(name, self.probe.finest)
            if found.value is None:
                return f"{name}: {found.reason}"
        return ""

    def models(self) -> list[Model]:
        """Return the models that the scene allows, the simplest first."""
        laws = (COULOMB, LUGRE) if self.free and self.law == LUGRE else (self.law,)
        averaged = [Model(0, law, order) for order in self.probe.averaging_orders for law in laws]
        return averaged + [Model(fidelity, law) for fidelity in (1, 2) for law in laws]

    def steps(self, model: Model) -> tuple[float | None, ...]:
        """Return the communication steps (s) to choose from, descending."""
        longest = MAX_PERIODS * self.scene.drive_period * (1.0 + ROUNDING)
        fit = [step for step in self.probe.ladder if step is None or step <= longest]
        return tuple(fit) if model.fidelity > 0 else self.probe.ladder

    def _suitable(self, model: Model, best: Evaluation | None) -> list[Evaluation] | str:
        """Return the candidates of a model that serve: few tolerances at the largest step.

        The reason where none does, or where they cost much more than the `best` of other models.
        """
        if model.fidelity == 0 and "event_times" in self.needs:
            return "averaged motion has no events"
        if model.fidelity > 0 and best is not None:
            cost = self._cost_of(model)
            # The beginning, in which the resonator rings, can cost some times more than the rest.
            if cost > 5.0 * best.cost:
                return f"costs about {cost:.3g} s, {best.candidate.model.name} {best.cost:.3g} s"
        choices, steps = tolerances(model), self.steps(model)
        refused = ""

        def excess(tolerance: float, step: float | None) -> float:
            nonlocal refused
            try:
                return self._evaluate(Candidate(model, tolerance, step)).excess
            except FmuError as error:
                refused = str(error)
                return inf

        fine = 0
        if self.probe.varying:  # the scene's own step, which shows all that happens
            longest = (self.scene.step_size or 0.0) * (1.0 + ROUNDING)
            fine = next((i for i, step in enumerate(steps) if step and step <= longest), 0)
        at = coarsest(lambda i: excess(choices[-1], steps[i]), len(steps), fine)
        if at is None:
            ran = any(candidate.model == model for candidate in self._evaluations)
            return self._nearest(model).why if ran else refused
        step = steps[at]
        others = choices[:-1]  # the tightest serves
        index = bisect_left(others, True, key=lambda one: excess(one, step) <= 1.0)
        found = [self._evaluate(Candidate(model, choices[index], step))]
        # Two smaller tolerances may cost less where periods are leapt over.
        for tolerance in choices[index + 1 : index + 3] if model.leaps else ():
            if excess(tolerance, step) >= found[-1].excess:
                break  # nothing is leapt over
            found.append(self._evaluate(Candidate(model, tolerance, step)))
        return found

    def _cost_of(self, model: Model) -> float:
        """Return about what resolved motion costs (s), 0 where the FMU cannot run it."""
        cost = sum(self._find(name, self.probe.finest).seconds for name in self.probe.steady_needs)
        if self.probe.run_needs:
            start = Candidate(model, tolerances(model)[0], self.steps(model)[0])
            try:
                cost += self.probe.cost(start, HEAD_PERIODS * self.scene.drive_period)
            except FmuError:
                return 0.0
        return cost

    def _nearest(self, model: Model | None = None) -> Evaluation:
        """Return the evaluation nearest to the needs, of all or a model; the finest of equals."""
        found = [t for t in self._evaluations.values() if model in (None, t.candidate.model)]
        return min(found, key=lambda t: (t.excess, -t.candidate.model.fidelity))

    def _evaluate(self, candidate: Candidate) -> Evaluation:
        if candidate not in self._evaluations:
            estimates: Estimates = {}
            cost = 0.0
            if self.probe.run_needs:
                estimates, cost = self.probe.measure(candidate)
            for name in self.probe.steady_needs:
                found = self._find(name, candidate)
                estimates[name] = steady_error(found, self._find(name, self.probe.finest), self.law)
                cost += found.seconds
            allowed = {name: self.needs[name].at(e.magnitude) for name, e in estimates.items()}
            self._evaluations[candidate] = Evaluation(candidate, estimates, allowed, cost)
        return self._evaluations[candidate]

    def _find(self, name: str, candidate: Candidate) -> SteadyAnswer:
        key = name, replace(candidate, step=None)
        if key not in self._steady:
            self._steady[key] = find(self.instance, self.scene.values, name, candidate)
            self.probe.drive_periods += self._steady[key].periods
        return self._steady[key]

    def _timed_again(self, good: Sequence[Evaluation]) -> list[Evaluation]:
        """Return candidates with the smallest of several costs, measured in turn.

        Those of up to twice the smallest are timed again, as a first timing may be 1 ms too long,
        until that has taken 0.4 s of CPU time.
        """
        costs = {one.candidate: one.cost for one in good}
        began = time.process_time()
        for _ in range(ROUNDS):
            longest = 2.0 * min(costs.values()) + 1e-3
            near = [one for one, cost in costs.items() if cost <= longest]
            if len(near) == 1 or time.process_time() - began > 0.4:
                break
            for candidate in near:
                cost = self.probe.cost(candidate) if self.probe.run_needs else 0.0
                for name in self.probe.steady_needs:
                    cost += find(self.instance, self.scene.values, name, candidate).seconds
                costs[candidate] = min(cost, costs[candidate])
        return [replace(one, cost=costs[one.candidate]) for one in good]

    def _choice(self, best: Evaluation | None, ruled_out: Mapping[Model, str]) -> Choice:
        """Return the answer: the best, or the nearest where there is none, and why no other."""
        evaluation = best or self._nearest()
        model = evaluation.candidate.model
        worst = evaluation.estimates[evaluation.worst]
        lacks = "no model can: the resolved motion gives no "
        none = lacks if worst.error == inf and not worst.magnitude else "none suffices: "
        reason = f"the cheapest that meets every need, to within {SAME_COST - 1.0:.0%}"
        probe = "steady motion"
        if self.probe.run_needs:
            probe = "leaps" if self.probe.leaps_serve else "whole"
        return Choice(
            **vars(model),
            step=evaluation.candidate.step,
            tolerance=evaluation.candidate.tolerance,
            meets=best is not None,
            error={name: estimate.error for name, estimate in evaluation.estimates.items()},
            allowed=evaluation.allowed,
            cost=evaluation.cost,
            ruled_out=tuple(
                RuledOut(**vars(other), why=ruled_out[other])
                for other in self.models()
                if best is None or other != model
            ),
            reason=reason if best else none + evaluation.why,
            probe=probe,
            probe_drive_periods=self.probe.drive_periods,
            drive_period=self.scene.drive_period,
            inputs=self.probe.inputs,
            jumps=any(signal.jumps for signal in self.scene.signals.values()),
        )


def coarsest(excess: Callable[[int], float], count: int, fine: int = 0) -> int | None:
    """Return the smallest index below `count` with `excess(index)` <= 1, None where none has.

    `excess` is error over allowed error. Gives up where two refinements in turn leave more than 0.7
    of it: a single one can be outside the range of convergence. But not above index `fine`: coarser
    ones may miss what happens.
    """
    stalled, before = 0, inf
    for index in range(count):
        found = excess(index)
        if found <= 1.0:
            return index
        stalled = stalled + 1 if isfinite(found) and found > 0.7 * before else 0
        if stalled >= 2 and index >= fine:
            return None
        before = found
    return None
