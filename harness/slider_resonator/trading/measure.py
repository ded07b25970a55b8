"""Measure the errors and the time of each method on a problem, within its budget.

The reference of all errors are Taylor series with located events, and shooting with these.

Methods are timed in turn, so that a busy moment of the machine affects all of them.
"""

import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, replace
from functools import partial
from math import inf
from operator import attrgetter
from pathlib import Path

import numpy as np

from slider_resonator.errors import FmuError, HarnessError
from slider_resonator.fmu.isolation.process import FmuDied, IsolatedFmu
from slider_resonator.output.progress import Progress, counted, no_progress
from slider_resonator.references.resolved.contact import STICK
from slider_resonator.references.resolved.simulate import simulate
from slider_resonator.steady.searches import SEARCHES
from slider_resonator.trading.fmu_methods import FmuMethods
from slider_resonator.trading.peer_methods import peer_methods, shoot
from slider_resonator.trading.problem import Method, Problem, Readings, SteadyMethod, solution_of
from slider_resonator.trading.result import Omission, Row, Trade

BUDGET = 1.0
"""CPU time (s) for the longest run or search of a method, and as much again for repeats."""
REPEATS = 5
TIME_LIMIT = 600.0
"""Default time limit of a run or a search of an FMU, s."""

_FAILURES = (ValueError, RuntimeError, ArithmeticError, ModuleNotFoundError, FmuError)


@dataclass(frozen=True)
class Reference:
    """The reference solution of a problem.

    `windows` are its readings; `sticks` says whether the slider sticks after the first drive
    period. `answers` are the steady velocity (m/s) and the blocking force (N), where there are any.
    """

    windows: Readings
    sticks: bool
    answers: Mapping[str, float | None]


def find_reference(problem: Problem) -> Reference:
    """Compute the reference; HarnessError where that is impossible."""
    try:
        held, periods = problem.lines(problem.periods), problem.periods
        run = simulate(problem.device, held, problem.readings(periods))
        found = problem.read(solution_of(run, located=True), periods)
        sought = SEARCHES if problem.steady else ()
        answers = {n: shoot(problem, n, simulate, 1e-10, inf).value for n in sought}
    except (ValueError, RuntimeError) as error:
        raise HarnessError(
            f"scene {problem.name}: the reference cannot follow it: {error}"
        ) from error
    edges = np.concatenate([[0.0], run.event_times, [inf]])
    later = np.diff(np.maximum(edges, problem.period)) > 1e-9 * problem.period
    return Reference(found, bool(np.any(later & (run.modes == STICK))), answers)


_Candidate = tuple[Row, Callable[[], float], float]
"""A row with the cost of its first run, what measures the cost once more, and the CPU time (s) of
that run."""


@contextmanager
def opened(fmus: Sequence[Path], time_limit: float) -> Iterator[dict[str, IsolatedFmu]]:
    """Yield FMUs, by their build, in processes of their own; FmuError for what is no FMU."""
    with ExitStack() as stack:
        instances: dict[str, IsolatedFmu] = {}
        for path in fmus:
            fmu = stack.enter_context(IsolatedFmu(path, time_limit))
            build = "native" if fmu.run(attrgetter("fmu.runs_without_python")) else "Python"
            instances[build if build not in instances else f"{build} {path.name}"] = fmu
        yield instances


def measure_trade(
    problem: Problem,
    instances: Mapping[str, IsolatedFmu],
    progress: Progress = no_progress,
    *,
    repeats: int = REPEATS,
    budget: float = BUDGET,
) -> Trade:
    """Measure all methods on a problem; `instances` are our FMUs by name.

    After a warm-up of all methods, times are taken in turn, `repeats` times or as often as the
    `budget` (s of CPU time) of a method allows. Raises HarnessError where the reference fails,
    FmuError for an FMU that refuses to run the scene by its own start values, and FmuDied for one
    that crashes or exceeds its time limit.
    """

    def report(row: Row, index: int, count: int, begin: float, share: float) -> None:
        label = f"{problem.name}: {counted(row.method, index, count)}"
        progress(label, begin + share * index / count)

    omissions: list[Omission] = []
    candidates: list[_Candidate] = []
    # The error of a result covers what scipy warns of on the way to it.
    with warnings.catch_warnings(action="ignore", category=RuntimeWarning):
        progress(f"{problem.name}: reference", 0.0)
        reference = find_reference(problem)
        fmus = [FmuMethods(problem, build, instance) for build, instance in instances.items()]
        for fmu in fmus:
            fmu.check_runs()
        methods = [method for fmu in fmus for method in fmu.methods()] + list(peer_methods(problem))
        answers = [answer for fmu in fmus for answer in fmu.answers()]
        answers += [answer for method in methods for answer in method.answers]
        given = (problem, reference, budget)
        tried = [(one.row, partial(_follow, *given, one, omissions)) for one in methods]
        tried += [(one.row, partial(_answer, *given, one)) for one in answers]
        for index, (row, measured) in enumerate(tried):
            report(row, index, len(tried), 0.0, 0.6)
            try:
                candidates.append(measured())
            except FmuDied:
                raise
            except _FAILURES as error:
                quantity = "all" if row.answer == "run" else row.answer
                omissions.append(Omission(problem.name, row.method, quantity, str(error)))
        # In rounds: in each of them every candidate with repeats left.
        counts = [min(repeats, int(budget / max(first, 1e-9))) for _, _, first in candidates]
        turns = sorted((turn, index) for index, n in enumerate(counts) for turn in range(n))
        costs: list[list[float]] = [[] for _ in candidates]
        for done, (_, index) in enumerate(turns):
            row, cost, _ = candidates[index]
            report(row, done, len(turns), 0.6, 0.4)
            costs[index].append(cost())
    pairs = zip(candidates, costs, strict=True)
    return Trade(
        scene=problem.name,
        title=problem.title,
        friction_law=problem.device.friction_law,
        periods=problem.periods,
        simulated=problem.duration(problem.periods),
        rows=tuple(replace(row, cpu=tuple(again or row.cpu)) for (row, *_), again in pairs),
        omissions=tuple(omissions),
    )


def _follow(
    problem: Problem, reference: Reference, budget: float, method: Method, omissions: list[Omission]
) -> _Candidate:
    """Run a method as far as its budget (s of CPU time) takes it; add what it does not report.

    Raises ValueError where it has no run, besides one of `_FAILURES`.
    """
    if method.min_periods > problem.periods:
        raise ValueError(f"a step is longer than the run of {problem.periods} drive periods")
    if method.cannot_stick and reference.sticks:
        raise ValueError("the slider sticks, which it does not cover")
    lengths = problem.horizons if problem.constant else (problem.periods,)
    horizons = [periods for periods in lengths if periods >= method.min_periods]
    method.run(method.min_periods + 1)  # compiles, fills caches
    begun = method.run(method.min_periods)[0]
    taken = method.run(method.min_periods + 1)[0]
    first = taken + (horizons[0] - method.min_periods - 1) * max(0.0, taken - begun)
    if first > 2.0 * budget:
        raise ValueError(
            f"the shortest run, {horizons[0]} of {problem.periods} drive periods, would take "
            f"{first:.1f} s of CPU time, more than its budget of {budget:g} s"
        )
    for periods, further in zip(horizons, [*horizons[1:], 0], strict=True):
        taken, solution = method.run(periods)
        if further / periods * taken > budget:
            break
    found = problem.errors(solution, reference.windows, periods)
    missing = dict(method.missing)
    if periods < problem.periods:
        missing["length"] = (
            f"followed over {periods} of {problem.periods} drive periods: the next longer run "
            f"would exceed its budget of {budget:g} s of CPU time"
        )
    if problem.beat is not None and "beat_frequency" not in found:
        missing["beat_frequency"] = "its own steps are too long or its run too short"
    omissions += [Omission(problem.name, method.row.method, *pair) for pair in missing.items()]
    simulated = problem.duration(periods)
    row = replace(
        method.row,
        scene=problem.name,
        periods=periods,
        cpu=(taken / simulated,),
        errors=found,
        start_cpu=solution.start_cpu,
        steps=solution.steps,
        evaluations=solution.evaluations,
        events=solution.events,
    )
    return row, lambda: method.seconds(periods) / simulated, taken


def _answer(
    problem: Problem, reference: Reference, budget: float, answer: SteadyMethod
) -> _Candidate:
    """Find an answer once; ValueError where there is none, besides one of `_FAILURES`."""
    quantity = answer.row.answer
    expected = reference.answers.get(quantity)
    if not expected:
        raise ValueError("the device has none under these inputs, or it is zero")
    found = answer.find(budget)
    if found.value is None:
        raise ValueError(found.reason)
    row = replace(
        answer.row,
        scene=problem.name,
        periods=found.periods,
        cpu=(found.seconds,),
        errors={quantity: abs(found.value - expected) / abs(expected)},
    )
    return row, lambda: answer.find(inf).seconds, found.seconds
