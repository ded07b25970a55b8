"""The peers: methods that a user might take instead of the FMU, setting by setting.

As methods on a problem they have runs, CPU times, and searches by shooting.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from functools import partial
from time import process_time
from typing import Any

import numpy as np
from scipy.integrate import DOP853

from slider_resonator.arrays import Array
from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.averaged.averaged_motion import simulate_averaged
from slider_resonator.references.equivalent_force import equivalent_force
from slider_resonator.references.resolved.simulate import simulate as simulate_series
from slider_resonator.references.resolved.trajectory import Trajectory
from slider_resonator.steady.reference_steady import ReferenceMotion, Simulate
from slider_resonator.steady.searches import SEARCHES, SteadyAnswer
from slider_resonator.trading.peers import event_free, located_scipy
from slider_resonator.trading.peers.switching_taylor import heyoka_in_one_call
from slider_resonator.trading.problem import Method, Problem, Solution, SteadyMethod, solution_of
from slider_resonator.trading.result import PEER, Row

MAX_EVALUATIONS = 1_000_000
"""Maximum evaluations of a method on sgn: one that chatters is stopped early."""
SHOOTING = 1e-6
"""Accuracy of shooting, in units of the state, with methods that lose their order at reversals."""
NOT_SHOT = "shooting needs a start in any state of the full device"


def peer_methods(problem: Problem) -> Iterator[Method]:
    """Yield the peers for the friction law of a problem."""
    peer = partial(_peer, problem)
    located = partial(peer, no_events="")
    yield located("Taylor series in Python", "", None, simulate_series, shooting=1e-9)
    is_lugre = problem.device.friction_law == 1
    family = "heyoka at its fastest" + (", bristle from path" if is_lugre else "")
    none = "the times of reversals are not reported"
    in_one_call = partial(peer, shooting=None, cannot_stick=True, no_events=none)
    for tolerance in (1e-3, 1e-6, 1e-9, 1e-12):
        heyoka = partial(heyoka_in_one_call, tolerance=tolerance)
        yield in_one_call(family, f"tol {tolerance:.0e}", tolerance, heyoka)
    if is_lugre:
        for tolerance in (1e-4, 1e-6, 1e-8, 1e-10):
            bristle = partial(event_free.simulate, rtol=tolerance, atol=1e-2 * tolerance)
            family, setting = "LSODA, bristle as state", f"tol {tolerance:.0e}"
            yield peer(family, setting, tolerance, bristle, max(1e-9, tolerance))
    else:
        for tolerance in (1e-3, 1e-5, 1e-8, 1e-11):
            scipy = partial(
                located_scipy.simulate, rtol=tolerance, atol=1e-2 * tolerance, steps_per_period=4
            )
            family, setting = "DOP853 with located events", f"tol {tolerance:.0e}"
            yield located(family, setting, tolerance, scipy, max(1e-9, tolerance))
        on_sgn = partial(event_free.simulate, method=DOP853, max_evaluations=MAX_EVALUATIONS)
        for atol in (1e-4, 1e-6, 1e-8, 1e-10):
            sgn = partial(on_sgn, rtol=1e-6, atol=atol)
            yield peer("DOP853 on sgn (the paper)", f"rtol 1e-06, atol {atol:.0e}", atol, sgn)
        for count in (16, 64, 256, 1024):
            stepping = partial(event_free.moreau_jean, steps_per_period=count)
            yield peer("Moreau-Jean", f"{count} steps a period", None, stepping)
        for share in (1e-1, 1e-2, 1e-3, 1e-4):
            setting = f"width {share:g} of the fast velocity"
            yield peer("tanh, LSODA", setting, None, partial(_regularised, share=share))
    none = "averaged motion has no events"
    yield peer("averaged equation, scipy", "", None, _averaged, shooting=None, no_events=none)


def _peer(
    problem: Problem,
    family: str,
    setting: str,
    tolerance: float | None,
    simulate: Callable[[Device, Sequence[HeldInputs], Array], Any],
    shooting: float | None = SHOOTING,
    *,
    cannot_stick: bool = False,
    no_events: str = "no event is located",
) -> Method:
    """Return a method on a problem, by the setting that its error depends on.

    `simulate` returns a trajectory, with the times of its events unless there are `no_events` for
    that reason, or a solution. `shooting` is the accuracy of shooting in units of the state, None
    for a method that cannot start in any state.
    """
    name, law = f"{family}, {setting}" if setting else family, problem.device.friction_law
    row = Row(PEER, family, name, law, tolerance=tolerance)

    def run(periods: int) -> tuple[float, Solution]:
        began = process_time()
        ends = np.empty(0) if problem.beat is None else problem.ends(periods)
        times = np.union1d(problem.readings(periods), ends)
        found = simulate(problem.device, problem.lines(periods), times)
        if not isinstance(found, Solution):
            found = solution_of(found, located=not no_events)
        position = found.position[np.searchsorted(times, ends)]
        history = ends[1:], np.diff(position) / problem.period
        return process_time() - began, replace(found, history=history)

    def seconds(periods: int) -> float:
        taken, solution = run(periods)
        return taken - (solution.start_cpu or 0.0)

    missing = {"event_times": no_events} if no_events else {}
    answers = []
    for quantity in SEARCHES:
        if shooting is None:
            missing[quantity] = NOT_SHOT
        else:
            find = partial(shoot, problem, quantity, simulate, shooting)
            answers.append(SteadyMethod(replace(row, answer=quantity), find))
    return Method(row, run, seconds, 1, cannot_stick, missing, answers)


def _regularised(
    device: Device, held: Sequence[HeldInputs], times: Array, *, share: float
) -> Trajectory:
    """Return the motion with a width of tanh that is a share of the fast velocity.

    Raises ValueError where there is no steady vibration, besides what `simulate` raises.
    """
    width = share * equivalent_force(device).velocity_amplitude
    return event_free.simulate(device, held, times, width=width, rtol=1e-7, atol=1e-9)


def _averaged(device: Device, held: Sequence[HeldInputs], times: Array) -> Solution:
    run = simulate_averaged(device, held, times)
    return Solution(times, run.position, run.velocity, run.mean_velocity)


def shoot(
    problem: Problem, quantity: str, simulate: Simulate, tolerance: float, budget: float
) -> SteadyAnswer:
    """Return a steady velocity or blocking force by shooting.

    Raises RuntimeError when that takes more CPU time (s) than its budget.
    """
    simulated: list[float] = []
    began = process_time()

    def counted(device: Device, held: Sequence[HeldInputs], times: Array) -> Trajectory:
        if process_time() - began > budget:
            raise RuntimeError(
                f"the search by shooting takes more than its budget of {budget:g} s of CPU time"
            )
        simulated.append((held[-1].stop - held[0].start) / problem.period)
        return simulate(device, held, times)

    phase, load, ratio = (problem.inputs[name] for name in ("phase", "load", "frequency_ratio"))
    motion = ReferenceMotion(problem.device, phase, ratio, simulate=counted, tolerance=tolerance)
    is_velocity = quantity == "steady_velocity"
    value = motion.steady_velocity(load) if is_velocity else motion.blocking_force()
    seconds, none = process_time() - began, "the search by shooting found none"
    return SteadyAnswer(seconds, value, none, round(sum(simulated)))
