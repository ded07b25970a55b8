"""Short problems that the tests of the trade share."""

from slider_resonator.references.resolved.simulate import simulate
from slider_resonator.trading.problem import Problem, Readings, problem_of, solution_of
from tests.harness.scene_text import scene_of


def problem(text: str, max_periods: int | None = None) -> Problem:
    return problem_of(scene_of(text), {}, max_periods)


def reference_of(problem: Problem) -> Readings:
    """The readings of a problem by the Taylor references, over its whole run."""
    periods = problem.periods
    run = simulate(problem.device, problem.lines(periods), problem.readings(periods))
    return problem.read(solution_of(run, located=True), periods)


TABLE_1 = ""
LUGRE = "[device]\nfriction_law = 1\nbristle_stiffness = 1e4\n"
RAMP = """
[inputs]
load = { ramp = [[0.0, 0.0], [0.02, 0.1]] }
[run]
drive_periods = 16
steps_per_period = 8
"""
SCAN = """
[inputs]
frequency_deviation = { ramp = [[0.0, -0.1], [0.02, 0.1]] }
amplitude_deviation = { steps = [[0.0, 0.0], [0.008, -1.0], [0.012, 0.5]] }
load = { ramp = [[0.0, 0.0], [0.02, 0.1]] }
[run]
drive_periods = 16
steps_per_period = 2
"""
BEAT = """
[inputs]
frequency_ratio = 1.05
[run]
drive_periods = 1600
steps_per_period = 1
"""
STICKING = "[device]\nbase_amplitude = 5e-8\n"
