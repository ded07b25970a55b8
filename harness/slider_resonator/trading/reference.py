"""The reference of all errors: Taylor series with located events, and shooting with it."""

from dataclasses import dataclass
from math import inf

import numpy as np

from slider_resonator.errors import HarnessError
from slider_resonator.references.resolved.contact import STICK
from slider_resonator.references.resolved.simulate import simulate
from slider_resonator.trading.method import STEADY
from slider_resonator.trading.peer_methods import shoot
from slider_resonator.trading.problem import Problem
from slider_resonator.trading.solution import WindowReadings, solution_of, windows

SHOOTING = 1e-10
"""Accuracy of the steady state in units of its scale."""


@dataclass(frozen=True)
class Reference:
    """The reference solution of a problem.

    `windows` are its readings; `sticks` says whether the slider sticks after the first drive
    period. The steady velocity (m/s) and the blocking force (N) are None where there is none.
    """

    windows: WindowReadings
    sticks: bool
    steady_velocity: float | None
    blocking_force: float | None


def find_reference(problem: Problem) -> Reference:
    """Compute the reference; HarnessError where that is impossible."""
    try:
        held, periods = problem.lines(problem.periods), problem.periods
        run = simulate(problem.device, held, problem.readings(periods))
        found = windows(problem, solution_of(run, located=True), periods)
        answers = dict.fromkeys(STEADY, None)
        if problem.steady:
            answers = {n: shoot(problem, n, simulate, SHOOTING, inf)[1].value for n in STEADY}
    except (ValueError, RuntimeError) as error:
        raise HarnessError(
            f"scene {problem.name}: the reference cannot follow it: {error}"
        ) from error
    edges = np.concatenate([[0.0], run.event_times, [inf]])
    later = np.diff(np.maximum(edges, problem.period)) > 1e-9 * problem.period
    return Reference(found, bool(np.any(later & (run.modes == STICK))), **answers)
