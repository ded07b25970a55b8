"""The full equations by scipy, with every change of contact mode located.

Within one contact mode the equations are smooth, so that a method of scipy keeps its order. Steps
are bounded by a fraction of the fastest period, and each is searched on a finer grid with slopes,
so that no pair of close roots is missed.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import partial

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.resolved.contact import LIFTED, STICK
from slider_resonator.references.resolved.mode_sequence import ModeSequence
from slider_resonator.references.resolved.segment import Segment, SegmentResult
from slider_resonator.references.resolved.trajectory import Trajectory
from slider_resonator.trade.peers.first_crossing import first_crossing
from slider_resonator.trade.peers.scipy_methods import Dense, Method, scipy_method, take_step

STEPS_PER_FASTEST_PERIOD = 16
_SEARCHED_PER_STEP = 8
_NOISE = 1e-15


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
            margin = partial(self._margin_at, dense, event)
            values, slopes = self._margin(event, grid, states)
            floor = _NOISE * float(np.abs(values).max())
            crossing = first_crossing(grid, values, slopes, margin, floor)
            if crossing is not None:
                crossings.append((crossing, event))
        return min(crossings, default=None)

    def _margin_at(self, dense: Dense, event: int, time: float) -> tuple[float, float]:
        value, slope = self._margin(event, time, dense(time))
        return float(value), float(slope)

    def _margin(self, event: int, time: float | Array, states: Array) -> tuple[Array, Array]:
        """Return the margin of an event, which happens where the margin is 0, and its rate.

        In a slip the margin is the velocity in the slip direction, in a stick the friction left
        before the slider breaks loose in the direction ``event``.
        """
        equations, segment = self._equations, self._segment
        _, velocity, displacement, resonator_velocity = states
        theta = segment.theta + self._rate * np.asarray(time)
        local = np.asarray(time)
        angle_rate = self._angle_rate + self._acceleration * local
        angle = segment.angle + 0.5 * (self._angle_rate + angle_rate) * local
        load = segment.load + segment.load_rate * local
        needed = equations.needed_force(load, theta, displacement, resonator_velocity)
        limit = equations.friction_limit(angle)
        if segment.mode != STICK:
            acceleration = (needed - segment.mode * limit) / equations.inertia
            return segment.mode * velocity, segment.mode * acceleration
        resonator_acceleration = (
            equations.base_acceleration * np.sin(theta)
            - equations.damping_rate * resonator_velocity
            - equations.stiffness_rate * displacement
        )
        needed_rate = (
            equations.coupling_damping * resonator_acceleration
            + equations.coupling_stiffness * resonator_velocity
            + self._rate
            * (equations.force_sine * np.cos(theta) - equations.force_cosine * np.sin(theta))
            - segment.load_rate
        )
        limit_rate = angle_rate * equations.friction_amplitude * np.cos(angle)
        return limit - event * needed, limit_rate - event * needed_rate
