"""The full equations by CVODE with its own root finding for the changes of contact mode.

Within a mode the equations are smooth and not stiff, so Adams' method is the one to take. CVODE
looks for sign changes between the ends of its steps, so two roots within one are lost: a peer for
measurements of cost, not a reference.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.resolved.contact import LIFTED, STICK
from slider_resonator.references.resolved.equations import Equations
from slider_resonator.references.resolved.mode_sequence import ModeSequence
from slider_resonator.references.resolved.segment import Segment, SegmentResult
from slider_resonator.references.resolved.trajectory import Trajectory
from slider_resonator.trade.peers.sundials import MAX_STEPS, cvode

_FOUND_A_ROOT = 2


def simulate(
    device: Device, held: Sequence[HeldInputs], times: Array, *, tolerance: float
) -> Trajectory:
    """Return the motion of a device under held inputs at ``times`` (shape (n,), s).

    Takes the inputs that ``located_events.simulate`` takes; ``tolerance`` is relative and, in
    fractions of a characteristic motion, absolute. ``steps`` is 0: CVODE does not report them.
    Raises ValueError as the other does; RuntimeError when the solver gives up;
    ModuleNotFoundError without scikit-sundae.
    """
    solver = cvode()

    def follow(segment: Segment) -> SegmentResult:
        return _follow(solver, segment, tolerance)

    return ModeSequence(device, follow, times).run(held)


def _follow(cvode: Any, segment: Segment, tolerance: float) -> SegmentResult:
    """Follow one segment; the integrated position is the displacement since its start."""
    equations = segment.equations
    slopes = equations.slopes(
        segment.mode, segment.load, segment.theta, segment.angle, segment.frequency_ratio
    )

    def right_hand_side(time: float, state: Array, change: Array) -> None:
        change[:] = slopes(time, state)

    options: dict[str, Any] = {}
    if segment.mode != LIFTED:
        margins = _margins(equations, segment)
        options = {"eventsfn": margins, "num_events": len(margins.direction)}  # type: ignore[attr-defined]
    solver = cvode(
        right_hand_side,
        method="Adams",
        rtol=tolerance,
        atol=tolerance * equations.state_scales(segment.load),
        max_step=2.0 * math.pi / equations.fastest_rate(segment.frequency_ratio) / 4.0,
        max_num_steps=MAX_STEPS,
        **options,
    )
    instants = np.union1d(segment.samples, [0.0, segment.span])
    solution = solver.solve(instants, np.array([0.0, *segment.state[1:]]))
    if not solution.success:
        raise RuntimeError(f"CVODE gave up: {solution.message}; use a greater tolerance")
    event = 0
    if solution.status == _FOUND_A_ROOT:
        event = -segment.mode
        if segment.mode == STICK:
            left = np.empty(2)
            options["eventsfn"](solution.t[-1], solution.y[-1], left)
            event = 1 if left[0] < left[1] else -1
    duration = float(solution.t[-1]) if event else segment.span
    covered = segment.samples[: np.searchsorted(segment.samples, duration, side="right")]
    samples = solution.y[np.searchsorted(solution.t, covered)].reshape(-1, 4)
    samples[:, 0] += segment.state[0]
    displacement, velocity, resonator, resonator_velocity = solution.y[-1].tolist()
    return SegmentResult(
        duration=duration,
        state=(segment.state[0] + displacement, velocity, resonator, resonator_velocity),
        event=event,
        samples=samples,
        steps=0,
        evaluations=int(solution.nfev),
    )


def _margins(equations: Equations, segment: Segment) -> Callable[[float, Array, Array], None]:
    """Return what falls to zero at an event: velocity in a slip, friction left in a stick."""
    rate, ratio, mode = equations.drive_frequency, segment.frequency_ratio, segment.mode

    def margins(time: float, state: Array, left: Array) -> None:
        if mode != STICK:
            left[0] = mode * state[1]
            return
        theta, angle = segment.theta + rate * time, segment.angle + ratio * rate * time
        needed = equations.needed_force(segment.load, theta, float(state[2]), float(state[3]))
        limit = equations.friction_limit(angle)
        left[:] = limit - needed, limit + needed

    count = 1 if mode != STICK else 2
    margins.terminal = [True] * count  # type: ignore[attr-defined]
    margins.direction = [-1] * count  # type: ignore[attr-defined]
    return margins
