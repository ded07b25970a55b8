"""Measure the errors and the time of each method on a problem, within its budget.

Methods are timed in turn, so that a busy moment of the machine affects all of them.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import asdict, dataclass, replace
from math import inf
from pathlib import Path
from typing import Any

from slider_resonator.errors import FmuError
from slider_resonator.fmu.isolation.process import FmuDied, IsolatedFmu
from slider_resonator.output.progress import Progress, counted, no_progress, part_of
from slider_resonator.trading.fmu_methods import FmuMethods, TaskRunner
from slider_resonator.trading.method import Label, Method, SteadyMethod, timed
from slider_resonator.trading.peer_methods import peer_answers, peer_methods
from slider_resonator.trading.problem import Problem
from slider_resonator.trading.reference import Reference, find_reference
from slider_resonator.trading.result import Omission, Row, Trade
from slider_resonator.trading.solution import QUANTITIES, Solution, errors


@dataclass(frozen=True)
class Timed:
    """Work to be timed `repeats` times: `seconds` does it once and returns the time taken."""

    name: str
    seconds: Callable[[], float]
    repeats: int


def in_turn(everything: Sequence[Timed], progress: Progress = no_progress) -> list[list[float]]:
    """Return the seconds of each; in every round, each with repeats left is timed once.

    `progress` receives the name of the work and the share of the repeats that is done.
    """
    seconds: list[list[float]] = [[] for _ in everything]
    total = sum(work.repeats for work in everything)
    done = 0
    for turn in range(max((work.repeats for work in everything), default=0)):
        for work, taken in zip(everything, seconds, strict=True):
            if turn < work.repeats:
                progress(counted(work.name, done, total), done / total)
                taken.append(work.seconds())
                done += 1
    return seconds


BUDGET = 1.0
"""CPU time (s) for the longest run or search of a method, and as much again for repeats."""
REPEATS = 5

_FAILURES = (ValueError, RuntimeError, ArithmeticError, ModuleNotFoundError, FmuError)


@dataclass(frozen=True)
class _Candidate:
    """A row without its times: `seconds` measures one, to be divided by `per`.

    `estimate` (s) is the time of the first run, used where the budget allows no other.
    """

    row: Row
    seconds: Callable[[], float]
    per: float
    estimate: float

    def timed(self, seconds: Sequence[float]) -> Row:
        """Return the row with its times."""
        return replace(
            self.row, cpu=tuple(second / self.per for second in seconds or [self.estimate])
        )


TIME_LIMIT = 600.0
"""Default time limit of a run or a search of an FMU, s."""


@contextmanager
def opened(fmus: Sequence[Path], time_limit: float) -> Iterator[dict[str, IsolatedFmu]]:
    """Yield FMUs, by their build, in processes of their own; FmuError for what is no FMU."""
    with ExitStack() as stack:
        instances: dict[str, IsolatedFmu] = {}
        for path in fmus:
            fmu = stack.enter_context(IsolatedFmu(path, time_limit))
            build = "native" if fmu.runs_without_python else "Python"
            instances[build if build not in instances else f"{build} {path.name}"] = fmu
        yield instances


def measure_trades(
    problems: Sequence[Problem],
    instances: Mapping[str, TaskRunner],
    progress: Progress = no_progress,
    *,
    repeats: int = REPEATS,
    budget: float = BUDGET,
) -> Iterator[Trade]:
    """Measure all methods on problems, and yield each result; raises as `measure_trade` does."""
    for index, problem in enumerate(problems):
        part = part_of(progress, index, len(problems))
        yield measure_trade(problem, instances, part, repeats=repeats, budget=budget)


def measure_trade(
    problem: Problem,
    instances: Mapping[str, TaskRunner],
    progress: Progress,
    *,
    repeats: int,
    budget: float = BUDGET,
) -> Trade:
    """Measure all methods on a problem; `instances` are our FMUs by name.

    After a warm-up of all methods, times are taken in turn, `repeats` times or as often as the
    `budget` (s of CPU time) of a method allows. Raises HarnessError where the reference fails, and
    FmuDied for an FMU that crashes or exceeds its time limit.
    """
    with warnings.catch_warnings():
        # The error of a result covers what scipy warns of on the way to it.
        warnings.simplefilter("ignore", RuntimeWarning)
        return _measured(problem, instances, progress, repeats, budget)


def _measured(
    problem: Problem,
    instances: Mapping[str, TaskRunner],
    progress: Progress,
    repeats: int,
    budget: float,
) -> Trade:
    progress(f"{problem.name}: reference", 0.0)
    reference = find_reference(problem)
    fmus = [FmuMethods(problem, build, instance) for build, instance in instances.items()]
    methods = [method for fmu in fmus for method in fmu.methods()] + list(peer_methods(problem))
    answers = [answer for fmu in fmus for answer in fmu.answers()] + list(peer_answers(problem))
    notes = _Notes(problem.name)
    candidates: list[_Candidate] = []
    for index, method in enumerate(methods):
        label = counted(method.label.name, index, len(methods))
        progress(f"{problem.name}: {label}", 0.4 * index / len(methods))
        candidates += _follow(problem, reference, method, budget, notes)
    for index, answer in enumerate(answers):
        label = counted(answer.label.name, index, len(answers))
        progress(f"{problem.name}: {label}", 0.4 + 0.2 * index / len(answers))
        candidates += _answer(problem, reference, answer, budget, notes)
    notes.answers_of(methods)
    works = [
        Timed(c.row.method, c.seconds, min(repeats, int(budget / max(c.estimate, 1e-9))))
        for c in candidates
    ]
    seconds = in_turn(
        works, lambda name, share: progress(f"{problem.name}: {name}", 0.6 + 0.4 * share)
    )
    return Trade(
        scene=problem.name,
        title=problem.title,
        friction_law=problem.device.friction_law,
        periods=problem.periods,
        simulated=problem.duration(problem.periods),
        rows=tuple(c.timed(taken) for c, taken in zip(candidates, seconds, strict=True)),
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
    problem: Problem, reference: Reference, method: Method, budget: float, notes: _Notes
) -> list[_Candidate]:
    """Run a method as far as its budget (s of CPU time) takes it; empty where it has no run."""
    label = method.label
    if method.min_periods > problem.periods:
        reason = f"a step is longer than the run of {problem.periods} drive periods"
        notes.add(label, "all", reason)
        return []
    if method.cannot_stick and reference.sticks:
        notes.add(label, "all", "the slider sticks, which it does not cover")
        return []
    horizons = [periods for periods in problem.lengths if periods >= method.min_periods]
    try:
        _timed_run(method, method.min_periods + 1)  # compiles, fills caches
        begun = _timed_run(method, method.min_periods)[0]
        taken = _timed_run(method, method.min_periods + 1)[0]
        first = taken + (horizons[0] - method.min_periods - 1) * max(0.0, taken - begun)
        if first > 2.0 * budget:
            reason = (
                f"the shortest run, {horizons[0]} of {problem.periods} drive periods, would take "
                f"{first:.1f} s of CPU time, more than its budget of {budget:g} s"
            )
            notes.add(label, "all", reason)
            return []
        for here, further in zip(horizons, [*horizons[1:], 0], strict=True):
            periods = here
            taken, solution = _timed_run(method, periods)
            if further / here * taken > budget:
                break
        found = errors(problem, solution, reference.windows, periods)
    except FmuDied:
        raise
    except _FAILURES as error:
        notes.add(label, "all", str(error))
        return []
    if periods < problem.periods:
        reason = (
            f"followed over {periods} of {problem.periods} drive periods: the next longer run "
            f"would exceed its budget of {budget:g} s of CPU time"
        )
        notes.add(label, "length", reason)
    for quantity in _expected(problem, reference):
        if quantity not in found:
            reason = method.missing.get(quantity, "its own steps are too long or its run too short")
            notes.add(label, quantity, reason)
    return [
        _Candidate(
            _row(problem, label, "run", periods, found, solution),
            seconds=lambda: method.seconds(periods),
            per=problem.duration(periods),
            estimate=taken,
        )
    ]


def _expected(problem: Problem, reference: Reference) -> list[str]:
    """Return the quantities that a solution of the problem should have."""
    optional = {"beat_frequency": problem.beat, "event_times": reference.windows.last_event}
    never = ("steady_velocity", "blocking_force")
    return [
        name
        for name in QUANTITIES
        if name not in never and (name not in optional or optional[name] is not None)
    ]


def _timed_run(method: Method, periods: int) -> tuple[float, Solution]:
    return timed(lambda: method.run(periods), method.clock)


def _answer(
    problem: Problem,
    reference: Reference,
    answer: SteadyMethod,
    budget: float,
    notes: _Notes,
) -> list[_Candidate]:
    """Find an answer once; empty where there is none."""
    expected: float | None = getattr(reference, answer.quantity)
    if not expected:
        reason = "the device has none under these inputs, or it is zero"
        notes.add(answer.label, answer.quantity, reason)
        return []
    try:
        taken, found = timed(lambda: answer.find(budget), answer.clock)
    except FmuDied:
        raise
    except _FAILURES as error:
        notes.add(answer.label, answer.quantity, str(error))
        return []
    if found.value is None:
        notes.add(answer.label, answer.quantity, found.reason)
        return []
    errors_found = {answer.quantity: abs(found.value - expected) / abs(expected)}
    row = _row(problem, answer.label, answer.quantity, found.periods, errors_found)

    def seconds() -> float:
        return timed(lambda: answer.find(inf), answer.clock)[0]

    return [_Candidate(row, seconds, 1.0, taken)]


def _row(
    problem: Problem,
    label: Label,
    answer: str,
    periods: int,
    errors: Mapping[str, float],
    solution: Solution | None = None,
) -> Row:
    fields = asdict(label)
    counts: dict[str, Any] = {
        name: getattr(solution, name, None)
        for name in ("start_cpu", "steps", "evaluations", "events")
    }
    return Row(
        scene=problem.name,
        answer=answer,
        method=fields.pop("name"),
        **fields,
        periods=periods,
        cpu=(),
        **counts,
        errors=errors,
    )
