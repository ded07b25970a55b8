"""Measuring a task: how far each method gets on its budget, its errors, and its time in turn."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass
from math import inf
from time import process_time

from slider_resonator.errors import FmuError
from slider_resonator.fmu.instance import Instance
from slider_resonator.studies.benchmark.in_turn import Progress, Timed, in_turn
from slider_resonator.studies.trade.fmu_methods import FmuMethods
from slider_resonator.studies.trade.method import Answer, Label, Method, cpu_seconds
from slider_resonator.studies.trade.motion import QUANTITIES, Motion, errors
from slider_resonator.studies.trade.peer_methods import peer_answers, peer_methods
from slider_resonator.studies.trade.referee import Referee, referee
from slider_resonator.studies.trade.result import Omission, Row, Trade
from slider_resonator.studies.trade.task import Task

BUDGET = 1.0
"""CPU time (s) for the longest run or search of a method, and as much again for repeats."""
REPEATS = 5

_TROUBLE = (ValueError, RuntimeError, ArithmeticError, ModuleNotFoundError, FmuError)


@dataclass(frozen=True)
class _Candidate:
    """A row without its times: `seconds` takes one, to be divided by `per`.

    `estimate` (s) is what the first run has taken, which stands where the budget has no other.
    """

    label: Label
    answer: str
    periods: int
    per: float
    seconds: Callable[[], float]
    estimate: float
    motion: Motion | None
    errors: Mapping[str, float]


def measure_trade(
    task: Task,
    instances: Mapping[str, Instance],
    progress: Progress,
    *,
    repeats: int = REPEATS,
    budget: float = BUDGET,
) -> Trade:
    """Measure all methods on a task; `instances` are our FMUs by what they are called.

    Nobody's times count until all are warm; then they are taken in turn, `repeats` times or as
    often as the `budget` (s of CPU time) of a method allows. HarnessError where the referee cannot
    follow the task.
    """
    with warnings.catch_warnings():
        # What scipy warns of on the way to a wrong result is told by the error of that result.
        warnings.simplefilter("ignore", RuntimeWarning)
        return _measured(task, instances, progress, repeats, budget)


def _measured(
    task: Task,
    instances: Mapping[str, Instance],
    progress: Progress,
    repeats: int,
    budget: float,
) -> Trade:
    progress(f"{task.name}: referee", 0.0)
    truth = referee(task)
    fmus = [FmuMethods(task, build, instance) for build, instance in instances.items()]
    methods = [method for fmu in fmus for method in fmu.methods()] + list(peer_methods(task))
    answers = [answer for fmu in fmus for answer in fmu.answers()] + list(peer_answers(task))
    notes = _Notes(task.name)
    candidates: list[_Candidate] = []
    for index, method in enumerate(methods):
        progress(f"{task.name}: {method.label.name}", 0.4 * index / len(methods))
        candidates += _follow(task, truth, method, budget, notes)
    for index, answer in enumerate(answers):
        progress(f"{task.name}: {answer.label.name}", 0.4 + 0.2 * index / len(answers))
        candidates += _answer(truth, answer, budget, notes)
    notes.answers_of(methods)
    timed = [
        Timed(c.label.name, c.seconds, min(repeats, int(budget / max(c.estimate, 1e-9))))
        for c in candidates
    ]
    seconds = in_turn(
        timed, lambda name, share: progress(f"{task.name}: {name}", 0.6 + 0.4 * share)
    )
    return Trade(
        scene=task.name,
        title=task.title,
        friction_law=task.device.friction_law,
        periods=task.periods,
        simulated=task.periods * task.period,
        uncertainty=truth.uncertainty,
        rows=tuple(_row(task, *pair) for pair in zip(candidates, seconds, strict=True)),
        omissions=tuple(notes.omissions),
    )


class _Notes:
    """The omissions so far."""

    def __init__(self, scene: str) -> None:
        self.scene = scene
        self.omissions: list[Omission] = []

    def add(self, label: Label, quantity: str, reason: str) -> None:
        """Note that a method is missing, or a quantity of it."""
        omission = Omission(self.scene, label.name, quantity, reason)
        if omission not in self.omissions:
            self.omissions.append(omission)

    def answers_of(self, methods: Sequence[Method]) -> None:
        """Note which methods give no steady velocity and blocking force at all."""
        for method in methods:
            for quantity in ("steady_velocity", "blocking_force"):
                if quantity in method.missing:
                    self.add(method.label, quantity, method.missing[quantity])


def _follow(
    task: Task, truth: Referee, method: Method, budget: float, notes: _Notes
) -> list[_Candidate]:
    """Run a method as far as its budget (s of CPU time) takes it; empty where that is nowhere."""
    label = method.label
    if method.least_periods > task.periods:
        reason = f"a step is longer than the run of {task.periods} drive periods"
        notes.add(label, "all", reason)
        return []
    if method.sticks_not and truth.sticks:
        notes.add(label, "all", "the slider sticks, which it does not cover")
        return []
    horizons = [periods for periods in task.lengths if periods >= method.least_periods]
    try:
        begun = _timed_run(method, method.least_periods)[0]  # compiles, fills caches
        taken = _timed_run(method, method.least_periods + 1)[0]
        first = taken + (horizons[0] - method.least_periods - 1) * max(0.0, taken - begun)
        if first > 2.0 * budget:
            reason = (
                f"the shortest run, {horizons[0]} of {task.periods} drive periods, would take "
                f"{first:.1f} s of CPU time, more than its budget of {budget:g} s"
            )
            notes.add(label, "all", reason)
            return []
        for here, further in zip(horizons, [*horizons[1:], 0], strict=True):
            periods = here
            taken, motion = _timed_run(method, periods)
            if further / here * taken > budget:
                break
        found = errors(task, motion, truth.windows, periods)
    except _TROUBLE as error:
        notes.add(label, "all", str(error))
        return []
    if periods < task.periods:
        reason = (
            f"followed over {periods} of {task.periods} drive periods: the next longer run would "
            f"exceed its budget of {budget:g} s of CPU time"
        )
        notes.add(label, "length", reason)
    for quantity in _expected(task, truth):
        if quantity not in found:
            reason = method.missing.get(quantity, "its own steps are too long or its run too short")
            notes.add(label, quantity, reason)
    return [
        _Candidate(
            label=label,
            answer="run",
            periods=periods,
            per=periods * task.period,
            seconds=lambda: method.seconds(periods),
            estimate=taken,
            motion=motion,
            errors=found,
        )
    ]


def _expected(task: Task, truth: Referee) -> list[str]:
    """Return the quantities that a trajectory of the task should have."""
    optional = {"beat_frequency": task.beat, "event_times": truth.windows.last_event}
    never = ("steady_velocity", "blocking_force")
    return [
        name
        for name in QUANTITIES
        if name not in never and (name not in optional or optional[name] is not None)
    ]


def _timed_run(method: Method, periods: int) -> tuple[float, Motion]:
    began = process_time()
    motion = method.run(periods)
    return process_time() - began, motion


def _answer(truth: Referee, answer: Answer, budget: float, notes: _Notes) -> list[_Candidate]:
    """Find an answer once; empty where there is none."""
    expected: float | None = getattr(truth, answer.quantity)
    if not expected:
        reason = "the device has none under these inputs, or it is zero"
        notes.add(answer.label, answer.quantity, reason)
        return []
    try:
        began = process_time()
        found = answer.find(budget)
        taken = process_time() - began
    except _TROUBLE as error:
        notes.add(answer.label, answer.quantity, str(error))
        return []
    if found.value is None:
        notes.add(answer.label, answer.quantity, found.reason)
        return []
    return [
        _Candidate(
            label=answer.label,
            answer=answer.quantity,
            periods=found.periods,
            per=1.0,
            seconds=lambda: cpu_seconds(lambda: answer.find(inf)),
            estimate=taken,
            motion=None,
            errors={answer.quantity: abs(found.value - expected) / abs(expected)},
        )
    ]


def _row(task: Task, candidate: _Candidate, seconds: Sequence[float]) -> Row:
    label, motion = candidate.label, candidate.motion
    fields = asdict(label)
    return Row(
        scene=task.name,
        answer=candidate.answer,
        method=fields.pop("name"),
        **fields,
        periods=candidate.periods,
        cpu=tuple(second / candidate.per for second in seconds or [candidate.estimate]),
        start_cpu=None if motion is None else motion.start_cpu,
        steps=None if motion is None else motion.steps,
        evaluations=None if motion is None else motion.evaluations,
        events=None if motion is None else motion.events,
        errors=candidate.errors,
    )
