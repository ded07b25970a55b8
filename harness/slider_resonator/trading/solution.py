"""Methods, their solutions of a problem, sampled at its readings, and the errors of these."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.checks.measures import (
    NoOscillation,
    dominant_frequency,
    peak,
    share_of,
    slow_displacement,
)
from slider_resonator.device.schedule import nearest
from slider_resonator.references.resolved.trajectory import Trajectory
from slider_resonator.steady.searches import SteadyAnswer
from slider_resonator.trading.problem import Problem
from slider_resonator.trading.result import Row


@dataclass(frozen=True)
class Solution:
    """Signals at `times` (s) and counts over the run, None where the method does not report them.

    `position` (m) and `velocity` (m/s) have the shape (n,) of the times, `mean_velocity` (m/s) too
    where the method has one of its own, `last_event` (s) where it locates events. `history` holds
    the times and mean velocities of its own steps, for the beat. `start_cpu` is the CPU time (s) of
    initialisation.
    """

    times: Array
    position: Array
    velocity: Array
    mean_velocity: Array | None = None
    last_event: Array | None = None
    history: tuple[Array, Array] | None = None
    steps: int | None = None
    evaluations: int | None = None
    events: int | None = None
    start_cpu: float | None = None


@dataclass(frozen=True)
class SteadyMethod:
    """A method to find a steady velocity (m/s) or a blocking force (N), the answer of its `row`.

    `find` takes its budget of CPU time (s) and raises RuntimeError where that is exceeded.
    """

    row: Row
    find: Callable[[float], SteadyAnswer]


@dataclass(frozen=True)
class Method:
    """A method to follow a motion, and the row that it fills.

    `run` follows it over a number of drive periods and returns its CPU time (s), too; `seconds`
    does so without the readings and returns the CPU time (s), without initialisation. A run has at
    least `min_periods`; a method that `cannot_stick` does not cover sticking. `missing` gives the
    reason for each quantity that the method does not compute, `answers` are its searches.
    """

    row: Row
    run: Callable[[int], tuple[float, Solution]]
    seconds: Callable[[int], float]
    min_periods: int = 1
    cannot_stick: bool = False
    missing: Mapping[str, str] = field(default_factory=dict)
    answers: Sequence[SteadyMethod] = ()


Readings = Mapping[str, Array]
"""What is compared by name, a row for each window of a problem, shape (w,) or (w, POINTS + 1).

Without `last_event` where no event is located.
"""


def windows(problem: Problem, solution: Solution, periods: int) -> Readings:
    """Return the readings of a solution over `periods` drive periods, window by window."""
    times = problem.windows(periods)
    places = np.array([nearest(solution.times, window) for window in times])
    position, last = solution.position[places], places[:, -1]
    lengths = times[:, -1] - times[:, 0]
    mean = (position[:, -1] - position[:, 0]) / lengths
    if solution.mean_velocity is not None:
        mean = solution.mean_velocity[last]
    slow = [slow_displacement(*one)[-1] for one in zip(times, position, lengths, strict=True)]
    return {
        "mean_velocity": mean,
        "slow_displacement": np.array(slow),
        "position": position,
        "velocity": solution.velocity[places],
        **({} if solution.last_event is None else {"last_event": solution.last_event[last]}),
    }


def solution_of(run: Trajectory, *, located: bool) -> Solution:
    """Return a trajectory as a solution; reversals stand for events that are not located."""
    last = np.append(0.0, run.event_times)[np.searchsorted(run.event_times, run.time, "right")]
    return Solution(
        times=run.time,
        position=run.position,
        velocity=run.velocity,
        last_event=last if located else None,
        steps=run.steps or None,
        evaluations=run.evaluations,
        events=len(run.event_times if located else run.reversal_times),
    )


def errors(
    problem: Problem, solution: Solution, reference: Readings, periods: int
) -> dict[str, float]:
    """Return the error of each quantity of a solution, infinite where it is not finite."""
    reported = {}
    for name, found in windows(problem, solution, periods).items():
        expected = reference[name][: len(found)] if name in reference else None
        if expected is not None and name == "last_event":
            reported["event_times"] = peak(found - expected) / problem.period
        elif expected is not None:
            reported[name] = share_of(peak(found - expected), peak(expected))
    if problem.beat is not None and solution.history is not None:
        beat = _beat(*solution.history, problem.beat)
        if beat is not None:
            reported["beat_frequency"] = abs(beat - problem.beat) / problem.beat
    return {name: error if np.isfinite(error) else np.inf for name, error in reported.items()}


def _beat(times: Array, mean_velocity: Array, beat: float) -> float | None:
    """Return the frequency (Hz) in the later half, None where it is sampled too thinly."""
    if len(times) < 32:
        return None
    steps = np.diff(times)
    if abs(steps[-1] - steps[0]) > 1e-6 * steps[0]:
        times, mean_velocity = times[:-1], mean_velocity[:-1]
    half = len(times) // 2
    later = times[half:]
    beats = (later[-1] - later[0]) * beat
    if len(later) < 16 or not beats > 2.0 or beats > 0.4 * (len(later) - 1):
        return None
    try:
        return dominant_frequency(later, mean_velocity[half:])
    except NoOscillation:
        return np.inf
