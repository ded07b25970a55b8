"""The full equations by scipy, with every change of contact mode located.

Within one contact mode the equations are smooth, so that DOP853 keeps its order. Steps are bounded
by a fraction of the fastest period, and each is searched on a finer grid: the event location of
scipy's solve_ivp would miss a mode that begins and ends within a step.
"""

import math
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

import numpy as np
from scipy.integrate import DOP853
from scipy.optimize import brentq

from slider_resonator.arrays import Array
from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.resolved.contact import LIFTED, STICK
from slider_resonator.references.resolved.mode_sequence import ModeSequence, Segment, SegmentResult
from slider_resonator.references.resolved.trajectory import Trajectory
from slider_resonator.trading.peers.event_free import STEPS_PER_FASTEST_PERIOD, take_step

Dense = Callable[[float | Array], Array]
"""States, shape (4,) or (4, n), at a time or at times (n,) within a step."""


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
    fastest = equations.fastest_rate(segment.now, segment.span)
    longest = 2.0 * math.pi / fastest / steps_per_period
    method: Callable[..., Any] = DOP853
    solver = method(
        equations.slopes(segment.mode, segment.theta, segment.angle, segment.now),
        0.0,
        np.array([0.0, *segment.state[1:]]),
        segment.span,
        first_step=min(longest, segment.span),
        max_step=longest,
        rtol=rtol,
        atol=atol * equations.state_scales(segment.now.load),
    )
    samples = [np.empty((0, 4))]
    steps = sampled = event = 0
    time, state = 0.0, solver.y
    while solver.status == "running" and not event:
        start = time
        take_step(solver, segment.start, "use a greater rtol")
        steps += 1
        dense = solver.dense_output()
        time, state = solver.t, solver.y
        crossing = _first_event(segment, dense, start, time)
        if crossing is not None:
            time, event = crossing
            state = dense(time)
        end = int(np.searchsorted(segment.samples, time, side="right"))
        if end > sampled:
            samples.append(dense(segment.samples[sampled:end]).T)
            sampled = end
    states = np.concatenate(samples)
    states[:, 0] += segment.state[0]
    displacement, *motion = state.tolist()
    return SegmentResult(
        duration=float(time),
        state=(segment.state[0] + displacement, *motion),
        event=event,
        samples=states,
        steps=steps,
        evaluations=solver.nfev,
    )


def _first_event(
    segment: Segment, dense: Dense, start: float, stop: float
) -> tuple[float, int] | None:
    """Return time (s) and direction of the first event within a step, None if there is none."""
    if segment.mode == LIFTED:
        return None
    grid = np.linspace(start, stop, 9)
    crossings = []
    for event in (-segment.mode,) if segment.mode else (1, -1):
        margin = partial(_margin, segment, dense, event)
        values = margin(grid)
        falls = np.flatnonzero(values[1:] < -1e-15 * np.abs(values).max())
        if falls.size:
            left, right = grid[falls[0] :][:2].tolist()
            crossings.append((_crossing(margin, left, right, float(np.abs(values).max())), event))
    return min(crossings, default=None)


def _margin(segment: Segment, dense: Dense, event: int, time: float | Array) -> Array:
    """Return the margin of an event, which happens where the margin is 0.

    In a slip it is the velocity in the slip direction, in a stick the friction left before the
    slider breaks loose in the direction ``event``.
    """
    equations = segment.equations
    _, velocity, displacement, resonator_velocity = dense(time)
    if segment.mode != STICK:
        return np.asarray(segment.mode * velocity)
    local, now = np.asarray(time), segment.now
    rate = equations.drive_frequency
    angle = segment.angle + now.turned(local, rate)
    load = now.load + now.load_rate * local
    theta = segment.theta + rate * local
    needed = equations.needed_force(load, theta, displacement, resonator_velocity)
    return np.asarray(equations.friction_limit(angle) - event * needed)


def _crossing(value: Callable[[float], Array], left: float, right: float, scale: float) -> float:
    """Return where a function of this scale falls below 0 between two times (s).

    The first may be a root, where the mode has just begun; the function counts as positive there.
    """
    root: float = brentq(
        lambda t: float(value(t)) if t > left else scale,
        left,
        right,
        xtol=1e-16 * (right - left),
        rtol=1e-15,
    )
    return root
