"""What every method is compared with: Taylor integration with located events, and its shooting."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf

import numpy as np

from slider_resonator.checks.measures.deviation import peak, share_of
from slider_resonator.errors import HarnessError
from slider_resonator.references.resolved import taylor
from slider_resonator.references.resolved.lugre_taylor import simulate_lugre
from slider_resonator.references.resolved.trajectory import Trajectory
from slider_resonator.steady.reference_steady import Simulate
from slider_resonator.studies.trade.motion import Windows, windows
from slider_resonator.studies.trade.peers.peer import motion_of
from slider_resonator.studies.trade.shooting import shoot
from slider_resonator.studies.trade.task import TRUTH_STEPS, Task

SHOOTING = 1e-10
"""Accuracy of the steady state in units of its scale."""


@dataclass(frozen=True)
class Referee:
    """The truth about a task.

    `windows` are its readings; `sticks` says whether the slider sticks after the first drive
    period; `uncertainty` is what half as many steps in which inputs that vary are held would change
    in the readings of the position, as a share of its peak. The steady velocity (m/s) and the
    blocking force (N) are None where there is none.
    """

    windows: Windows
    sticks: bool
    uncertainty: float
    steady_velocity: float | None
    blocking_force: float | None


def referee(task: Task) -> Referee:
    """Run and shoot the referee; HarnessError where that is impossible."""
    simulate: Simulate = simulate_lugre if task.device.friction_law == 1 else taylor.simulate
    try:
        run = _run(task, simulate, TRUTH_STEPS)
        found = windows(task, motion_of(run, located=True), task.periods)
        uncertainty = 0.0
        if not task.constant:
            coarse = _run(task, simulate, TRUTH_STEPS // 2)
            # Three times what second order leaves: corners between steps make it irregular.
            uncertainty = share_of(peak(coarse.position - run.position), peak(run.position))
        first = simulate(task.device, task.truth(1), np.empty(0)).stick_time
        answers = {}
        for quantity in ("steady_velocity", "blocking_force"):
            answers[quantity] = (
                shoot(task, quantity, simulate, SHOOTING, inf).value if task.steady else None
            )
    except (ModuleNotFoundError, ValueError, RuntimeError) as error:
        raise HarnessError(f"scene {task.name}: the referee cannot follow it: {error}") from error
    return Referee(
        found,
        run.stick_time > first + 1e-9 * task.period,
        uncertainty,
        answers["steady_velocity"],
        answers["blocking_force"],
    )


def _run(task: Task, simulate: Simulate, steps: int) -> Trajectory:
    return simulate(task.device, task.truth(task.periods, steps), task.readings(task.periods))
