"""The full equations by scipy, with every change of contact mode located.

Within one contact mode the equations are smooth, so that a method of scipy keeps its order. Steps
are bounded by a fraction of the fastest period, and each is searched on a finer grid.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import partial

import numpy as np
from scipy.optimize import brentq

from slider_resonator.arrays import Array
from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.resolved.contact import LIFTED, STICK
from slider_resonator.references.resolved.mode_sequence import ModeSequence
from slider_resonator.references.resolved.segment import Segment, SegmentResult
from slider_resonator.references.resolved.trajectory import Trajectory
from slider_resonator.trading.peers.scipy_methods import Dense, Method, scipy_method, take_step

STEPS_PER_FASTEST_PERIOD = 16
_SEARCHED_PER_STEP = 8
_NOISE = 1e-15
_HALVINGS = 60


def simulate(
    device: Device,
    held: Sequence[HeldInputs],
    times: Array,
    *,
    method: str = "DOP853",
    rtol: float = 1e-12,
    atol: float = 1e-14,
    steps_per_period: int = STEPS_PER_FASTEST_PERIOD,
) -> Trajectory:
    """Return the motion with Coulomb friction, as ``resolved.simulate`` does.

    ``method`` is DOP853, LSODA or Radau, ``rtol`` the relative tolerance of every step, ``atol``
    the absolute one in fractions of a characteristic velocity and displacement, and the fastest
    period takes at least ``steps_per_period`` steps, more than a loose tolerance needs. Raises
    ValueError as the other does, and for another method.
    """
    solver = scipy_method(method)

    def follow(segment: Segment) -> SegmentResult:
        return _Motion(segment).follow(solver, rtol, atol, steps_per_period)

    return ModeSequence(device, follow, times).run(held)


class _Motion:
    """One segment of motion: its right hand side, its events, and its integration.

    The integrated states are (displacement since the start of the segment, velocity, Y, Y').
    """

    def __init__(self, segment: Segment) -> None:
        self._equations = segment.equations
        self._segment = segment
        self._rate = segment.equations.drive_frequency
        self._angle_rate = segment.frequency_ratio * self._rate
        self._acceleration = segment.ratio_rate * self._rate

    def follow(
        self, method: Method, rtol: float, atol: float, steps_per_period: int
    ) -> SegmentResult:
        segment = self._segment
        fastest = self._equations.fastest_rate(segment.largest_ratio)
        longest_step = 2.0 * math.pi / fastest / steps_per_period
        solver = method(
            self._equations.slopes(
                segment.mode,
                segment.load,
                segment.theta,
                segment.angle,
                segment.frequency_ratio,
                load_rate=segment.load_rate,
                ratio_rate=segment.ratio_rate,
            ),
            0.0,
            np.array([0.0, *segment.state[1:]]),
            segment.span,
            first_step=min(longest_step, segment.span),
            max_step=longest_step,
            rtol=rtol,
            atol=atol * self._equations.state_scales(segment.load),
        )
        samples: list[Array] = []
        steps = sampled = event = 0
        time, state = 0.0, solver.y
        while solver.status == "running" and not event:
            start = time
            take_step(solver, segment.start, "use a greater rtol")
            steps += 1
            dense = solver.dense_output()
            time, state = solver.t, solver.y
            crossing = self._first_event(dense, start, time)
            if crossing is not None:
                time, event = crossing
                state = dense(time)
            end = int(np.searchsorted(segment.samples, time, side="right"))
            if end > sampled:
                samples.append(dense(segment.samples[sampled:end]).T)
                sampled = end
        states = np.concatenate([np.empty((0, 4)), *samples])
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

    def _first_event(self, dense: Dense, start: float, stop: float) -> tuple[float, int] | None:
        """Return time (s) and direction of the first event within a step, None if there is none."""
        if self._segment.mode == LIFTED:
            return None
        grid = np.linspace(start, stop, _SEARCHED_PER_STEP + 1)
        states = dense(grid)
        crossings = []
        for event in (-self._segment.mode,) if self._segment.mode else (1, -1):
            values = self._margin(event, grid, states)
            falls = np.flatnonzero(values[1:] < -_NOISE * np.abs(values).max())
            if falls.size:
                margin = partial(self._margin_at, dense, event)
                crossings.append((_crossing(margin, *grid[falls[0] :][:2].tolist()), event))
        return min(crossings, default=None)

    def _margin_at(self, dense: Dense, event: int, time: float) -> float:
        return float(self._margin(event, time, dense(time)))

    def _margin(self, event: int, time: float | Array, states: Array) -> Array:
        """Return the margin of an event, which happens where the margin is 0.

        In a slip it is the velocity in the slip direction, in a stick the friction left before the
        slider breaks loose in the direction ``event``.
        """
        equations, segment = self._equations, self._segment
        _, velocity, displacement, resonator_velocity = states
        if segment.mode != STICK:
            return np.asarray(segment.mode * velocity)
        local = np.asarray(time)
        theta = segment.theta + self._rate * local
        angle_rate = self._angle_rate + 0.5 * self._acceleration * local
        load = segment.load + segment.load_rate * local
        needed = equations.needed_force(load, theta, displacement, resonator_velocity)
        limit = equations.friction_limit(segment.angle + angle_rate * local)
        return np.asarray(limit - event * needed)


def _crossing(value: Callable[[float], float], left: float, right: float) -> float:
    """Return where a function falls below 0 between two times (s); the first may be a root."""
    begin, width = left, right - left
    for _ in range(_HALVINGS):
        if value(begin) > 0.0:
            root: float = brentq(value, begin, right, xtol=1e-16 * (right - begin), rtol=1e-15)
            return root
        width *= 0.5
        begin, right = left + width, left + 2.0 * width
    return left
