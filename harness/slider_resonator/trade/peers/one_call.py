"""Peers that follow a whole motion under constant inputs in one call of their integrator."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from time import process_time
from typing import Any, Literal

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.resolved.trajectory import LugreTrajectory, Trajectory
from slider_resonator.steady.reference_steady import Simulate
from slider_resonator.trade.peers.lugre_cvode import simulate_lugre_cvode
from slider_resonator.trade.peers.peer import NO_EVENTS, NOT_SHOT, Peer, solution_of
from slider_resonator.trade.peers.switching_taylor import SlidingRun, simulate_sliding
from slider_resonator.trade.solution import Solution


def heyoka_in_one_call(
    family: str, bristle: Literal["path", "state"], first: Simulate, tolerance: float
) -> Peer:
    """Return heyoka in one call; it starts where `first` is after one drive period.

    `bristle` says whether that of LuGre friction follows from the path or is a state.
    """

    def follow(device: Device, held: Sequence[HeldInputs], times: Array) -> Solution:
        inputs = _single(held)
        begin = min(2.0 * np.pi / device.drive_frequency, inputs.stop)
        early = times[times <= begin]
        began = process_time()
        start = first(device, [replace(inputs, stop=begin)], np.append(early, begin))
        started = process_time() - began
        if begin == inputs.stop:
            return replace(
                solution_of(start, located=False),
                times=early,
                position=start.position[:-1],
                velocity=start.velocity[:-1],
            )
        if start.contact_mode[-1] == 0:
            raise ValueError("the slider sticks after a drive period, which it does not cover")
        moving = device_at(device, start, -1)
        later = times[times > begin]
        rest = _motion(
            simulate_sliding(
                moving, inputs, later, tolerance=tolerance, bristle=bristle, start=begin
            ),
            later,
        )
        return replace(
            rest,
            times=times,
            position=np.concatenate([start.position[:-1], rest.position]),
            velocity=np.concatenate([start.velocity[:-1], rest.velocity]),
            start_cpu=started,
        )

    missing = {"event_times": "the times of reversals are not reported", **NOT_SHOT}
    setting = f"tol {tolerance:.0e}"
    return Peer(family, setting, tolerance, follow, cannot_stick=True, missing=missing)


def device_at(device: Device, run: Trajectory, index: int) -> Device:
    """Return the device that starts in the state of a trajectory at one of its samples."""
    names = ("position", "velocity", "resonator_displacement", "resonator_velocity")
    state: dict[str, Any] = {f"initial_{name}": float(getattr(run, name)[index]) for name in names}
    bent = run.bristle_deflection[index] if isinstance(run, LugreTrajectory) else 0.0
    return replace(device, **state, initial_bristle_deflection=float(bent))


def cvode_in_one_call(tolerance: float) -> Peer:
    """Return CVODE's BDF on LuGre friction with the bristle as a state."""
    return Peer(
        "CVODE BDF, bristle as state",
        f"tol {tolerance:.0e}",
        tolerance,
        partial(_cvode, tolerance=tolerance),
        missing={**NO_EVENTS, **NOT_SHOT},
    )


def _cvode(
    device: Device, held: Sequence[HeldInputs], times: Array, *, tolerance: float
) -> Solution:
    run = simulate_lugre_cvode(device, _single(held), times, tolerance=tolerance)
    return _motion(run, times)


def _single(held: Sequence[HeldInputs]) -> HeldInputs:
    if len(held) != 1:
        raise ValueError("inputs vary, which it does not cover")
    return held[0]


def _motion(run: SlidingRun, times: Array) -> Solution:
    return Solution(
        times,
        run.samples[:, 0],
        run.samples[:, 1],
        steps=run.steps or None,
        evaluations=run.evaluations or None,
        events=run.reversals or None,
    )
