"""Moreau-Jean time stepping: friction as an impulse per step, no event is located.

The smooth part is the theta method at 1/2, the friction impulse over a step is the one that stops
the slider at the end of the step where the friction limit allows that, else the limit. Sticking is
exact, reversals cost the order: the error falls with the first power of the step. The scheme of
Moreau (Unilateral contact and dry friction in finite freedom dynamics, 1988) and Jean (1999).
"""

from __future__ import annotations

from collections.abc import Sequence
from math import ceil, pi, sin

import numpy as np
from numpy.typing import NDArray

from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs, check_contiguous, check_times
from slider_resonator.references.resolved.contact import LIFTED
from slider_resonator.references.resolved.equations import Equations, equations_of, initial_state
from slider_resonator.references.resolved.trajectory import Trajectory

Array = NDArray[np.float64]

_SAME_INSTANT = 1e-9
"""Samples closer to the end of a step than this share of it are taken there."""


def simulate(
    device: Device, held: Sequence[HeldInputs], times: Array, *, steps_per_period: int
) -> Trajectory:
    """Return the motion of a device under held inputs at ``times`` (shape (n,), s).

    Takes the inputs that ``located_events.simulate`` takes. A step is at most a
    ``steps_per_period``-th of a drive period; those of held inputs are equal, and samples between
    their ends are interpolated linearly. ``contact_mode`` is the sign of the velocity (0 in a
    stick, 2 where the contact is open), ``reversals`` counts its changes between steps, and
    ``event_times`` is empty. Raises ValueError as the other does and for fewer steps than 1.
    """
    if steps_per_period < 1:
        raise ValueError(f"steps_per_period = {steps_per_period!r}: must be at least 1")
    check_contiguous(held)
    check_times(times, held)
    run = _Run(equations_of(device), initial_state(device), times)
    for inputs in held:
        run.follow(inputs, steps_per_period)
    return Trajectory(
        time=times,
        position=run.signals[:, 0],
        velocity=run.signals[:, 1],
        resonator_displacement=run.signals[:, 2],
        resonator_velocity=run.signals[:, 3],
        normal_force=run.signals[:, 4],
        friction_force=run.signals[:, 5],
        contact_mode=run.signals[:, 6].astype(np.int64),
        reversals=run.reversals,
        sticks=run.sticks,
        stick_time=run.stick_time,
        event_times=np.empty(0),
        steps=run.steps,
        evaluations=run.steps,
    )


class _Run:
    """The state between steps, samples and counts."""

    def __init__(
        self, equations: Equations, state: tuple[float, float, float, float], times: Array
    ) -> None:
        self.signals = np.empty((len(times), 7))
        self.reversals = 0
        self.sticks = 0
        self.stick_time = 0.0
        self.steps = 0
        self._equations = equations
        self._state = state
        self._times = times
        self._kept = 0
        self._theta = 0.0
        self._psi = 0.0
        self._slip = 0.0
        self._friction = 0.0

    def follow(self, inputs: HeldInputs, steps_per_period: int) -> None:
        """Step through held inputs."""
        equations = self._equations
        rate = equations.drive_frequency
        angle_rate = inputs.frequency_ratio * rate
        span = inputs.stop - inputs.start
        count = ceil(span * rate / (2.0 * pi) * steps_per_period * (1.0 - _SAME_INSTANT))
        step = span / count
        smooth = _SmoothStep(equations, step, inputs.load)
        theta, angle = self._theta, self._psi + inputs.phase
        x, v, y, u = self._state
        friction = self._friction
        limit_mean, limit_amplitude = equations.friction_mean, equations.friction_amplitude
        sticking = False
        for index in range(count):
            middle = (index + 0.5) * step
            free_v, free_u = smooth.free(v, y, u, theta + rate * middle)
            limit = step * max(0.0, limit_mean + limit_amplitude * sin(angle + angle_rate * middle))
            impulse = min(limit, max(-limit, free_v / smooth.mobility))
            # Where the impulse stops the slider, it does so exactly: -0.0 and rounding are no slip.
            stopped = abs(impulse) < limit
            next_v = 0.0 if stopped else free_v - smooth.mobility * impulse
            next_u = free_u - smooth.resonator_mobility * impulse
            after = (x + 0.5 * step * (v + next_v), next_v, y + 0.5 * step * (u + next_u), next_u)
            self._keep(inputs, (x, v, y, u, friction), (*after, impulse / step), index, step)
            x, v, y, u = after
            friction = impulse / step
            self._count(v, stopped, sticking, step)
            sticking = stopped
        self.steps += count
        self._state, self._friction = (x, v, y, u), friction
        self._theta += rate * span
        self._psi += angle_rate * span

    def _count(self, velocity: float, stopped: bool, sticking: bool, step: float) -> None:
        if stopped:
            self.sticks += not sticking
            self.stick_time += step
        elif velocity:
            self.reversals += velocity * self._slip < 0.0
            self._slip = velocity

    def _keep(
        self,
        inputs: HeldInputs,
        before: tuple[float, ...],
        after: tuple[float, ...],
        index: int,
        step: float,
    ) -> None:
        """Keep the samples within a step."""
        last = inputs.start + (index + 1 + _SAME_INSTANT) * step
        while self._kept < len(self._times) and (time := float(self._times[self._kept])) <= last:
            local = time - inputs.start
            share = min(1.0, max(0.0, local / step - index))
            row = [b + share * (a - b) for b, a in zip(before, after, strict=True)]
            equations = self._equations
            theta = np.array([self._theta + equations.drive_frequency * local])
            resonator = equations.resonator_motion(theta, np.array([row[:4]]))
            angle = self._psi + inputs.phase
            angle += inputs.frequency_ratio * equations.drive_frequency * local
            load = equations.normal_preload + equations.normal_amplitude * sin(angle)
            mode = float(np.sign(row[1])) if load > 0.0 else float(LIFTED)
            moved = [float(signal[0]) for signal in resonator]
            self.signals[self._kept] = (*row[:2], *moved, max(0.0, load), row[4], mode)
            self._kept += 1


class _SmoothStep:
    """One step of the theta method at 1/2 without friction, and what an impulse does to it.

    The unknowns are the velocities of slider and resonator at the end of the step, from two linear
    equations whose matrix is inverted once.
    """

    def __init__(self, equations: Equations, step: float, load: float) -> None:
        e, h = equations, step
        self._equations = e
        self._load = load
        self._step = h
        pull = 0.5 * h * (e.coupling_damping + 0.5 * h * e.coupling_stiffness) / e.inertia
        swing = 0.5 * h * (e.damping_rate + 0.5 * h * e.stiffness_rate)
        # v1 - pull u1 = a and v1 + (1 + swing) u1 = b, the second with v' moved to the left.
        self._pull, self._inverse = pull, 1.0 / (1.0 + swing + pull)
        self._swing = swing
        self.mobility = (1.0 + swing) * self._inverse / e.inertia
        self.resonator_mobility = -self._inverse / e.inertia

    def free(self, v: float, y: float, u: float, theta: float) -> tuple[float, float]:
        """Return both velocities after the step; ``theta`` is the drive angle at its middle."""
        e, h = self._equations, self._step
        sine, cosine = sin(theta), sin(theta + 0.5 * pi)
        middle = y + 0.25 * h * u
        force = e.coupling_stiffness * middle + 0.5 * e.coupling_damping * u
        force += e.force_sine * sine + e.force_cosine * cosine - self._load
        a = v + h * force / e.inertia
        shaken = e.base_acceleration * sine - 0.5 * e.damping_rate * u - e.stiffness_rate * middle
        b = v + u + h * shaken
        after_u = (b - a) * self._inverse
        return a + self._pull * after_u, after_u
