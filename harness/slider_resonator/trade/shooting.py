"""Steady velocity and blocking force by shooting with any integrator, within a budget."""

from __future__ import annotations

from collections.abc import Sequence
from time import process_time

from slider_resonator.arrays import Array
from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.resolved.trajectory import Trajectory
from slider_resonator.steady.reference_steady import (
    Simulate,
    reference_blocking_force,
    reference_steady_velocity,
)
from slider_resonator.trade.method import SteadyAnswer
from slider_resonator.trade.problem import Problem


def shoot(
    problem: Problem, quantity: str, simulate: Simulate, tolerance: float, budget: float
) -> SteadyAnswer:
    """Return a steady velocity or blocking force by shooting with any integrator.

    Raises RuntimeError when that takes more CPU time (s) than its budget.
    """
    turns: list[float] = []
    began = process_time()

    def counted(device: Device, held: Sequence[HeldInputs], times: Array) -> Trajectory:
        if process_time() - began > budget:
            raise RuntimeError(
                f"the search by shooting takes more than its budget of {budget:g} s of CPU time"
            )
        turns.append((held[-1].stop - held[0].start) / problem.period)
        return simulate(device, held, times)

    phase, load, ratio = (problem.inputs[name] for name in ("phase", "load", "frequency_ratio"))
    if quantity == "steady_velocity":
        value = reference_steady_velocity(
            problem.device, phase, load, ratio, simulate=counted, tolerance=tolerance
        )
    else:
        value = reference_blocking_force(
            problem.device, phase, ratio, simulate=counted, tolerance=tolerance
        )
    return SteadyAnswer(value, "the search by shooting found none", round(sum(turns)))
