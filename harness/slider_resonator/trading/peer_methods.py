"""Peers as methods on a problem: their runs, CPU times, and searches by shooting."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial
from time import process_time

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.resolved.trajectory import Trajectory
from slider_resonator.steady.reference_steady import (
    Simulate,
    reference_blocking_force,
    reference_steady_velocity,
)
from slider_resonator.trading.method import Label, Method, SteadyAnswer, SteadyMethod
from slider_resonator.trading.peers.peer import Peer
from slider_resonator.trading.peers.registry import peers
from slider_resonator.trading.problem import Problem
from slider_resonator.trading.result import PEER
from slider_resonator.trading.solution import Solution


def shoot(
    problem: Problem, quantity: str, simulate: Simulate, tolerance: float, budget: float
) -> tuple[float, SteadyAnswer]:
    """Return the CPU time (s), and a steady velocity or blocking force by shooting.

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
    velocity = partial(reference_steady_velocity, problem.device, phase, load, ratio)
    force = partial(reference_blocking_force, problem.device, phase, ratio)
    search = velocity if quantity == "steady_velocity" else force
    value = search(simulate=counted, tolerance=tolerance)
    found = SteadyAnswer(value, "the search by shooting found none", round(sum(simulated)))
    return process_time() - began, found


def peer_methods(problem: Problem) -> Iterator[Method]:
    """Yield the peers as methods."""
    for peer in peers(problem):
        yield Method(
            _label(problem, peer),
            partial(_run, problem, peer),
            partial(_seconds, problem, peer),
            cannot_stick=peer.cannot_stick,
            missing=peer.missing,
        )


def peer_answers(problem: Problem) -> Iterator[SteadyMethod]:
    """Yield the searches for steady velocity and blocking force, of peers that support shooting."""
    for quantity in ("steady_velocity", "blocking_force"):
        for peer in peers(problem):
            if peer.simulate is not None:
                find = partial(shoot, problem, quantity, peer.simulate, peer.shooting)
                yield SteadyMethod(_label(problem, peer), quantity, find)


def _label(problem: Problem, peer: Peer) -> Label:
    name = f"{peer.family}, {peer.setting}" if peer.setting else peer.family
    return Label(PEER, peer.family, name, problem.device.friction_law, tolerance=peer.tolerance)


def _run(problem: Problem, peer: Peer, periods: int) -> tuple[float, Solution]:
    began = process_time()
    times, ends = problem.readings(periods), problem.ends(periods)
    if problem.beat is not None:
        times = np.union1d(times, ends)
    solution = peer.follow(problem.device, problem.lines(periods), times)
    if problem.beat is not None:
        position = solution.position[np.searchsorted(times, ends)]
        history = ends[1:], np.diff(position) / problem.period
        solution = replace(solution, history=history)
    return process_time() - began, solution


def _seconds(problem: Problem, peer: Peer, periods: int) -> float:
    taken, solution = _run(problem, peer, periods)
    return taken - (solution.start_cpu or 0.0)
