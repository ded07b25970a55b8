"""The cheapest model that a scene needs: by the laws of the errors, confirmed by a short probe."""

from __future__ import annotations

from dataclasses import replace
from math import ceil, inf
from pathlib import Path

from slider_resonator.errors import FmuError, SceneError
from slider_resonator.fmu.instance import Instance, instantiate
from slider_resonator.fmu.opening import open_fmu
from slider_resonator.scenes.scene import Scene
from slider_resonator.studies.choose.candidate import (
    COULOMB,
    LUGRE,
    START_TOLERANCE,
    Candidate,
    Model,
)
from slider_resonator.studies.choose.choice import Choice, RuledOut
from slider_resonator.studies.choose.cost import run_cost, search_cost
from slider_resonator.studies.choose.errors import Wrong
from slider_resonator.studies.choose.ladder import step_ladder
from slider_resonator.studies.choose.probe import FINEST_TOLERANCE, Probe
from slider_resonator.studies.choose.search import coarsest
from slider_resonator.studies.choose.steady_need import Found, find, steady_error
from slider_resonator.studies.choose.tried import Tried

HOPELESS = 1000.0
"""Times by which the law of averaging must exceed what is allowed to spare the probe."""
TRIED_FIRST = 1e-6
"""Tolerance with which communication steps are judged, and the search for the tolerance begins."""
FEWEST_PERIODS = 40
"""Drive periods that a search by shooting takes at least."""


def choose(scene: Scene, fmu: str | Path) -> Choice:
    """Return the cheapest model, tolerance and communication step that the scene's needs allow.

    `fmu` is where it is tried. Raises SceneError for a scene without needs and FmuError or Refusal
    where the FMU cannot run the resolved device.
    """
    with open_fmu(fmu) as opened, instantiate(opened) as instance:
        return choose_with(instance, scene)


def choose_with(instance: Instance, scene: Scene) -> Choice:
    """Choose as `choose` does, in an instance that is there already."""
    return _Choosing(instance, scene).answer()


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
    """The choice for one scene; SceneError where that needs nothing."""

    def __init__(self, instance: Instance, scene: Scene) -> None:
        if scene.need is None:
            raise SceneError(
                f"{scene.source}: scene {scene.name} has no [need]; allowed is a table of what it "
                "needs, such as mean_velocity = { rel = 0.01 }"
            )
        self.instance = instance
        self.scene = scene
        self.needs = scene.need.needs
        self.probe = Probe(instance, scene)
        self.scales = self.probe.scales
        self.ladder: tuple[float | None, ...] = (None,)
        if self.probe.run_needs:
            self.ladder = step_ladder(self.probe)
        self.law = scene.device.friction_law
        self.periods = 0
        self._tried: dict[Candidate, Tried] = {}
        self._steady: dict[tuple[str, Candidate], Found] = {}

    def answer(self) -> Choice:
        """Try the models from the cheapest on."""
        impossible = self._impossible()
        if impossible:
            self._try(Candidate(self.probe.truth_model, START_TOLERANCE, self.ladder[0]))
            models = self.models()
            return self._choice(
                None, [RuledOut(m.fidelity, m.friction_law, impossible) for m in models]
            )
        if self.ladder[0] is not None:
            self.probe.resolve(self.ladder[0])
        ruled_out: list[RuledOut] = []
        best: Tried | None = None
        for model in sorted(self.models(), key=self._least_cost):
            why = self._excluded(model)
            if why is None and best is not None and self._least_cost(model) >= best.cost:
                why = (
                    f"costs at least {self._least_cost(model):.3g} s, the chosen {best.cost:.3g} s"
                )
            if why is None:
                tried, why = self._cheapest_of(model)
                if tried is not None and (best is None or tried.cost < best.cost):
                    if best is not None:
                        ruled_out.append(_dearer(best, tried))
                    best = tried
                    continue
                if tried is not None and best is not None:
                    ruled_out.append(_dearer(tried, best))
                    continue
            ruled_out.append(RuledOut(model.fidelity, model.friction_law, why))
        return self._choice(best, ruled_out)

    def _impossible(self) -> str:
        """Return why not even the resolved device has what is needed, empty where it does."""
        if self.probe.no_beat:
            return f"beat: {self.probe.no_beat}"
        finest = Candidate(self.probe.truth_model, FINEST_TOLERANCE, None)
        for name in self.probe.steady_needs:
            found = self._find(name, finest)
            if found.value is None:
                return f"{name}: {found.reason}"
        return ""

    def models(self) -> list[Model]:
        """Return the models that the scene allows."""
        free = self.scene.need is not None and self.scene.need.friction_law == "free"
        laws = (COULOMB, LUGRE) if free and self.law == LUGRE else (self.law,)
        return [Model(fidelity, law) for fidelity in (0, 1, 2) for law in laws]

    def _excluded(self, model: Model) -> str | None:
        """Return why a model needs no probe, None where it does."""
        if model.fidelity > 0:
            return None
        if "event_times" in self.needs:
            return "averaged motion has no events"
        law = self.scales.averaging_error or 0.0
        for name in ("mean_velocity", "velocity") if self.law == COULOMB else ():
            need = self.needs.get(name)
            if need and need.rel is None and law > HOPELESS * (need.abs or inf):
                return f"{name}: {self._law_of(model)}, allowed is {need.abs:.2g} m/s"
        return None

    def _law_of(self, model: Model) -> str:
        """Return what the laws of the errors say of a model, empty where they say nothing."""
        scales = self.scales
        if model.friction_law != self.law and scales.kappa:
            share = scales.bristle_share
            return f"the bristle bends for a share of about {share:.1g} of the time"
        if model.fidelity == 0 and scales.averaging_error is not None:
            return f"averaging errs by the order of {scales.averaging_error:.1g} m/s"
        if model.fidelity == 1:
            return (
                f"the resonator starts from rest and remembers {scales.memory:.2g} drive periods, "
                f"r_m is {scales.mass_ratio:.2g}"
            )
        return ""

    def _least_cost(self, model: Model) -> float:
        return self.cost(Candidate(model, model.tolerances[0], self.ladder[0]), FEWEST_PERIODS)

    def cost(self, candidate: Candidate, periods: int) -> float:
        """Return the cost of the run and of searches that took so many drive periods."""
        cost = 0.0
        if candidate.step is not None:
            duration = self.probe.duration
            cost += run_cost(candidate, self.scales, duration, ceil(duration / candidate.step))
        if self.probe.steady_needs:
            cost += search_cost(candidate.model, candidate.tolerance, periods, self.scales)
        return cost

    def _cheapest_of(self, model: Model) -> tuple[Tried | None, str]:
        """Return the cheapest candidate of a model that meets all needs, or why none does."""
        tolerances = model.tolerances
        first = tolerances.index(TRIED_FIRST) if TRIED_FIRST in tolerances else 0
        refused = ""

        def excess(tolerance: float, step: float | None) -> float:
            nonlocal refused
            try:
                return self._try(Candidate(model, tolerance, step)).excess
            except FmuError as error:
                refused = str(error)
                return inf

        def first_step(tolerance: float) -> int | None:
            return coarsest(lambda i: excess(tolerance, self.ladder[i]), len(self.ladder), 2.0)

        tight = tolerances[-1]
        at = first_step(tight)
        if at is None:
            return None, self._why_not(model, refused)
        step = self.ladder[at]
        index = coarsest(lambda i: excess(tolerances[i], step), len(tolerances), 10.0, first)
        if index is None:
            return None, self._why_not(model, refused)
        return self._try(Candidate(model, tolerances[index], step)), ""

    def _why_not(self, model: Model, refused: str) -> str:
        if all(candidate.model != model for candidate in self._tried):
            return refused
        return "; ".join(filter(None, (self._nearest(model).why, self._law_of(model))))

    def _nearest(self, model: Model | None = None) -> Tried:
        """Return what came nearest to the needs, of all that was tried or of a model."""
        tried = [t for t in self._tried.values() if model in (None, t.candidate.model)]
        return min(tried, key=lambda t: t.excess)

    def _try(self, candidate: Candidate) -> Tried:
        if candidate not in self._tried:
            wrong: dict[str, Wrong] = {}
            periods = 0
            if self.probe.run_needs:
                wrong |= self.probe.run_errors(candidate)
            for name in self.probe.steady_needs:
                found = self._find(name, candidate)
                finest = Candidate(self.probe.truth_model, FINEST_TOLERANCE, None)
                wrong[name] = steady_error(found, self._find(name, finest), self.law)
                periods += found.periods
            allowed = {name: self.needs[name].at(wrong[name].size) for name in wrong}
            cost = self.cost(candidate, max(periods, FEWEST_PERIODS))
            self._tried[candidate] = Tried(candidate, wrong, allowed, cost)
        return self._tried[candidate]

    def _find(self, name: str, candidate: Candidate) -> Found:
        key = name, replace(candidate, step=None)
        if key not in self._steady:
            self._steady[key] = find(self.instance, self.scene.values, name, candidate)
            self.periods += self._steady[key].periods
        return self._steady[key]

    def _choice(self, best: Tried | None, ruled_out: list[RuledOut]) -> Choice:
        tried = best or self._nearest()
        model = tried.candidate.model
        covers = self.probe.covers if self.probe.run_needs else "steady motion"
        reason = "the cheapest that meets every need" if best else f"none suffices: {tried.why}"
        return Choice(
            fidelity=model.fidelity,
            friction_law=model.friction_law,
            step=tried.candidate.step,
            tolerance=tried.candidate.tolerance,
            meets=best is not None,
            error={name: wrong.error for name, wrong in tried.wrong.items()},
            allowed=tried.allowed,
            cost=tried.cost,
            ruled_out=tuple(ruled_out),
            reason=reason,
            probe=covers,
            probe_drive_periods=self.probe.drive_periods + self.periods,
            scales=self.scales,
        )


def _dearer(tried: Tried, best: Tried) -> RuledOut:
    model = tried.candidate.model
    why = f"meets the needs too, at {tried.cost:.3g} s instead of {best.cost:.3g} s"
    return RuledOut(model.fidelity, model.friction_law, why)
