"""The full equations by scipy, with every change of contact mode located.

Within one contact mode the equations are smooth, so that DOP853 keeps its order and scipy locates
the end of the mode. Steps are bounded by a fraction of the fastest period: no event hides in one.
"""

import math
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

from slider_resonator.arrays import Array
from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.resolved.contact import LIFTED, STICK
from slider_resonator.references.resolved.mode_sequence import ModeSequence, Segment, SegmentResult
from slider_resonator.references.resolved.trajectory import Trajectory

STEPS_PER_FASTEST_PERIOD = 16
TINY = float(np.finfo(float).tiny)


def simulate(
    device: Device,
    held: Sequence[HeldInputs],
    times: Array,
    *,
    rtol: float = 1e-12,
    atol: float = 1e-14,
    steps_per_period: int = STEPS_PER_FASTEST_PERIOD,
) -> Trajectory:
    """Return the motion with Coulomb friction, as ``resolved.simulate`` does.

    ``rtol`` is the relative tolerance of every step, ``atol`` the absolute one in fractions of a
    characteristic velocity and displacement, and the fastest period takes at least
    ``steps_per_period`` steps, more than a loose tolerance needs. Raises ValueError as the other
    does, RuntimeError where a step fails.
    """
    follow = partial(_follow, rtol=rtol, atol=atol, steps_per_period=steps_per_period)
    return ModeSequence(device, follow, times).run(held)


def _follow(segment: Segment, rtol: float, atol: float, steps_per_period: int) -> SegmentResult:
    """Integrate displacement since the start of the segment, velocity, Y and Y'."""
    equations = segment.equations
    longest = 2.0 * math.pi / equations.fastest_rate(segment.largest_ratio) / steps_per_period
    directions: dict[int, tuple[int, ...]] = {LIFTED: (), STICK: (1, -1)}
    events = directions.get(segment.mode, (-segment.mode,))
    margins = [_margin(segment, event) for event in events]
    solve: Callable[..., Any] = solve_ivp
    found = solve(
        equations.slopes(segment.mode, segment.theta, segment.angle, segment.now),
        (0.0, segment.span),
        np.array([0.0, *segment.state[1:]]),
        method="DOP853",
        dense_output=True,
        events=margins,
        first_step=min(longest, segment.span),
        max_step=longest,
        rtol=rtol,
        atol=atol * equations.state_scales(segment.now.load),
    )
    if not found.success:
        raise RuntimeError(
            f"DOP853 failed at t = {segment.start + float(found.t[-1])!r} s: {found.message}; "
            "use a greater rtol"
        )
    duration, happened = float(found.t[-1]), 0
    for event, margin, times in zip(events, margins, found.t_events, strict=True):
        if len(times):  # to some 1e-15 s, and with a secant to rounding
            happened, near = event, (duration - 1e-6 * longest, duration)
            before, after = map(margin, near, found.sol(near).T)
            if before > after:
                duration += (near[1] - near[0]) * after / (before - after)
    inside = segment.samples[segment.samples <= duration]
    states = found.sol(np.append(inside, duration)).T
    states[:, 0] += segment.state[0]
    return SegmentResult(
        duration=duration,
        state=tuple(states[-1].tolist()),
        event=happened,
        samples=states[:-1],
        steps=len(found.t) - 1,
        evaluations=found.nfev,
    )


def _margin(segment: Segment, event: int) -> Callable[[float, Array], float]:
    """Return what falls to 0 at an event; at the start 0 is none.

    In a slip it is the velocity in the slip direction, in a stick the friction left before the
    slider breaks loose in the direction ``event``.
    """
    equations, now = segment.equations, segment.now
    rate = equations.drive_frequency

    def margin(time: float, state: Array) -> float:
        if segment.mode != STICK:
            left = segment.mode * state[1]
        else:
            angle = segment.angle + now.turned(time, rate)
            load, theta = now.load + now.load_rate * time, segment.theta + rate * time
            needed = equations.needed_force(load, theta, state[2], state[3])
            left = equations.friction_limit(angle) - event * needed
        return float(left) or TINY

    margin.terminal, margin.direction = True, -1.0  # type: ignore[attr-defined]
    return margin
