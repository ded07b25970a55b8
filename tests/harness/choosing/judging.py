"""Judge a choice by full runs: whether it meets the needs, and the cheapest choice that does.

Nothing of the chooser's own probe is used here but the list of candidates and their costs.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import inf

import numpy as np

from slider_resonator.checks.measures.frequency import NoOscillation, dominant_frequency
from slider_resonator.choosing.candidate import Candidate, Model
from slider_resonator.choosing.choice import Choice
from slider_resonator.choosing.choosing import candidates
from slider_resonator.choosing.cost import search_cost
from slider_resonator.choosing.scales import scales_of
from slider_resonator.device.schedule import Schedule, communication_points, in_order
from slider_resonator.device.signal import Signal
from slider_resonator.errors import FmuError
from slider_resonator.fmu.instance import Instance
from slider_resonator.fmu.record import Record
from slider_resonator.fmu.run import run
from slider_resonator.scenes.need_table import STEADY_NEEDS
from slider_resonator.scenes.scene import Scene
from slider_resonator.steady.blocking_force import find_blocking
from slider_resonator.steady.search_result import SearchResult
from slider_resonator.steady.steady_velocity import find_steady

WITHIN = 1.5
"""Largest allowed cost of a choice, relative to the cheapest candidate."""
STEPS_TRIED = 2
SHOWN = ("position", "velocity", "mean_velocity", "reversals", "last_event_time")
FINE_STEPS = 8
MAX_POINTS = 25_000


@dataclass(frozen=True)
class Verdict:
    """Errors over allowed errors of the choice, and the cheapest candidate that meets the needs."""

    choice: Choice
    excess: Mapping[str, float]
    cheaper: Candidate | None
    cheaper_cost: float

    @property
    def met(self) -> bool:
        """Whether the choice meets every need, or reports rightly that none can."""
        if not self.choice.meets:
            return self.cheaper is None
        return max(self.excess.values()) <= 1.0

    @property
    def cheap(self) -> bool:
        return self.cheaper is None


class Judge:
    """The reference of a scene: the resolved device in fine steps."""

    def __init__(self, instance: Instance, scene: Scene) -> None:
        assert scene.need is not None
        self.instance = instance
        self.scene = scene
        self.needs = scene.need.needs
        self.reference = {"fidelity": 2.0, "friction_law": float(scene.device.friction_law)}
        self.reference |= {"tolerance": 1e-13}
        self._found: dict[tuple[object, ...], float | None] = {}
        self._periods: dict[tuple[object, ...], int] = {}
        self._records: dict[Candidate, Record] = {}
        self._true_records: dict[float, Record] = {}

    def excess(self, candidate: Candidate) -> dict[str, float]:
        """Return errors over allowed errors of a candidate by need."""
        try:
            return {name: self._excess(name, candidate) for name in self.needs}
        except (FmuError, NoOscillation):
            return {name: inf for name in self.needs}

    def _excess(self, name: str, candidate: Candidate) -> float:
        if name in STEADY_NEEDS:
            both = (self.reference, candidate.parameters)
            resolved, found = (self._steady(name, parameters) for parameters in both)
            if resolved is None or found is None:
                return inf
            return _over(abs(found - resolved), self.needs[name].at(resolved))
        assert candidate.step is not None
        record, true = self._record(candidate), self.reference_record(candidate.step)
        error, size = self._error(name, record, true, candidate.step)
        return _over(error, self.needs[name].at(size))

    def _error(self, name: str, record: Record, true: Record, step: float) -> tuple[float, float]:
        period = 2.0 * np.pi / self.scene.device.drive_frequency
        if name == "mean_velocity":
            return abs(record.final(name) - true.final(name)), abs(true.final(name))
        if name == "beat":
            ratio = self.scene.signals["frequency_ratio"].at(0.0)
            beats = abs(ratio - round(ratio)) / period * 0.5 * float(record.times[-1])
            if not (0.0 < abs(ratio - round(ratio)) < 0.1 and beats >= 2.0):
                return inf, 0.0
            found, resolved = (_beat(r, step) for r in (record, true))
            turns = resolved * period / abs(ratio - round(ratio))
            if not (0.8 <= turns <= 1.2 or 1.8 <= turns <= 2.2 or 2.8 <= turns <= 3.2):
                return inf, 0.0
            return abs(found - resolved), resolved
        checkpoints = self.scene.schedule().times
        at, there = (np.searchsorted(r.times, checkpoints) for r in (record, true))
        assert np.array_equal(record.times[at], true.times[there]), "at the checkpoints"
        if name == "event_times":
            if record.final("reversals") != true.final("reversals"):
                return inf, period
            events = true["last_event_time"]
            shown = record["last_event_time"][at]
            return float(np.abs(shown[:, None] - np.unique(events)).min(axis=1).max()), period
        difference = record[name][at] - true[name][there]
        return float(np.abs(difference).max()), float(np.abs(true[name][there]).max())

    def _record(self, candidate: Candidate) -> Record:
        if candidate not in self._records:
            assert candidate.step is not None
            own = self.scene.with_step(candidate.step).schedule()
            values = {**self.scene.parameters, **candidate.parameters}
            self._records[candidate] = run(self.instance, values, own, outputs=SHOWN)
        return self._records[candidate]

    def reference_record(self, step: float) -> Record:
        """Return the resolved run with inputs as they vary, at the points of a run too.

        Lines that the FMU cannot follow, and those of parameters, are held at their means.
        """
        if step not in self._true_records:
            own = self.scene.with_step(step).schedule()
            stop, passes_on = float(own.times[-1]), self.instance.fmu.interpolates
            inputs, tuning = dict(self.scene.signals), dict(self.scene.tuning)
            held = tuning if passes_on else {**inputs, **tuning}
            corners = [t for s in (*inputs.values(), *tuning.values()) for t in s.times]
            points = [time for time in corners if 0.0 < time < stop]
            times = np.unique(np.concatenate([own.times, self.scene.schedule().times, points]))
            if not all(signal.hold for signal in held.values()):
                fine = max(step / FINE_STEPS, stop / MAX_POINTS)
                fine = step / max(2, round(step / fine))
                times = np.union1d(times, communication_points(stop, fine, points))
                middles = np.append(0.5 * (times[1:] + times[:-1]), times[-1])
                means = {
                    name: Signal(tuple(times), tuple(map(s.at, middles)))
                    for name, s in held.items()
                    if not s.hold
                }
                inputs |= {name: s for name, s in means.items() if name in inputs}
                tuning |= {name: s for name, s in means.items() if name in tuning}
            values = {**self.scene.parameters, **self.reference}
            samples = Schedule(times, *in_order(inputs), tuning=tuning, interpolates=passes_on)
            self._true_records[step] = run(self.instance, values, samples, outputs=SHOWN)
        return self._true_records[step]

    def search_cost(self, candidate: Candidate) -> float:
        """Return the cost (s) of finding the steady needs with a candidate."""
        names = [name for name in self.needs if name in STEADY_NEEDS]
        for name in names:
            self._steady(name, candidate.parameters)
        periods = sum(self._periods[name, *candidate.parameters.values()] for name in names)
        if not names:
            return 0.0
        scales = scales_of(self.scene)
        return search_cost(candidate.model, candidate.tolerance, periods, scales)

    def _steady(self, name: str, parameters: Mapping[str, float]) -> float | None:
        key = name, *parameters.values()
        if key not in self._found:
            self._found[key], self._periods[key] = self._search(name, parameters)
        return self._found[key]

    def _search(self, name: str, parameters: Mapping[str, float]) -> tuple[float | None, int]:
        values = {**self.scene.values, **parameters}
        if parameters["fidelity"] == 0:
            self.instance.start(values)
            return self.instance.value(name), 0
        search: SearchResult
        if name == "steady_velocity":
            search = find_steady(self.instance, values)
        else:
            del values["load"]
            search = find_blocking(self.instance, values)
        settled = {"steady_velocity": ("steady", "stuck"), "blocking_force": ("blocked",)}[name]
        return getattr(search, name) if search.status in settled else None, search.periods


def judge(instance: Instance, scene: Scene, choice: Choice) -> Verdict:
    """Return the verdict on a choice.

    Costs are those of the counts that `slider_resonator.choosing.cost` weighs. Of the
    candidates below two thirds of its cost, or of all where it says that none suffices, the finest
    of each model are run: a coarser one of the same model is not better.
    """
    reference = Judge(instance, scene)
    excess = reference.excess(Candidate(choice.model, choice.tolerance, choice.step))
    bound = choice.cost / WITHIN if choice.meets else inf
    finest: dict[Model, dict[float | None, tuple[Candidate, float]]] = {}
    for candidate, cost in candidates(instance, scene):
        cost += reference.search_cost(candidate)
        if cost < bound:
            finest.setdefault(candidate.model, {})[candidate.step] = candidate, cost
    for steps in finest.values():
        for step in sorted(steps, key=lambda step: step or 0.0)[:STEPS_TRIED]:
            candidate, cost = steps[step]
            if max(reference.excess(candidate).values()) <= 1.0:
                return Verdict(choice, excess, candidate, cost)
    return Verdict(choice, excess, None, inf)


def described(verdict: Verdict, name: str) -> str:
    """Return a verdict in words."""
    choice = verdict.choice
    return (
        f"{name}: {choice.model.name}, step {choice.step}, tolerance {choice.tolerance:g}, "
        f"{choice.reason}; errors over allowed {dict(verdict.excess)}; cost {choice.cost:.3g} s, "
        f"cheaper {verdict.cheaper} at {verdict.cheaper_cost:.3g} s"
    )


def _over(error: float, allowed: float) -> float:
    return error / allowed if allowed > 0.0 else inf if error > 0.0 else 0.0


def _beat(record: Record, step: float) -> float:
    """Return the frequency (Hz) from the later half of the points at equal steps (s)."""
    grid = step * np.arange(int(record.times[-1] / step * (1.0 + 1e-9)) + 1)
    grid = grid[grid <= record.times[-1]]
    later = grid[len(grid) // 2 :]
    at = np.searchsorted(record.times, later)
    return dominant_frequency(later, record["mean_velocity"][at])
