"""Moreau-Jean time stepping: friction as an impulse per step, no event is located.

The smooth part is the theta method at 1/2, the friction impulse over a step is the one that stops
the slider at the end of the step where the friction limit allows that, else the limit. Sticking is
exact, reversals cost the order: the error falls with the first power of the step. The scheme of
Moreau (Unilateral contact and dry friction in finite freedom dynamics, 1988) and Jean (1999).
"""

from array import array
from collections.abc import Sequence
from functools import partial
from math import ceil, pi, sin

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.resolved.equations import Equations
from slider_resonator.references.resolved.trajectory import Trajectory
from slider_resonator.trading.peers.event_free import RunWithoutEvents

_SAME_INSTANT = 1e-9
"""Share of a step by which rounding may exceed a whole number of steps."""


def simulate(
    device: Device, held: Sequence[HeldInputs], times: Array, *, steps_per_period: int
) -> Trajectory:
    """Return the motion of a device under held inputs at ``times`` (shape (n,), s).

    Takes the inputs that ``resolved.simulate`` takes. A step is at most a
    ``steps_per_period``-th of a drive period; those of held inputs are equal, and samples between
    their ends are interpolated linearly. ``contact_mode`` is the sign of the velocity (0 in a
    stick, 2 where the contact is open), ``reversals`` counts its changes between steps, and
    ``event_times`` is empty. Raises ValueError as the other does.
    """
    follow = partial(_follow, steps_per_period=steps_per_period)
    return RunWithoutEvents(device, times).run(held, follow)


def _follow(run: RunWithoutEvents, inputs: HeldInputs, *, steps_per_period: int) -> None:
    """Step through held inputs; the friction of the last step goes on to the next."""
    equations, recorder = run.equations, run.recorder
    rate = equations.drive_frequency
    angle_rate, half = inputs.frequency_ratio * rate, 0.5 * inputs.ratio_rate * rate
    load, load_rate = inputs.load, inputs.load_rate
    span = inputs.stop - inputs.start
    count = ceil(span * rate / (2.0 * pi) * steps_per_period * (1.0 - _SAME_INSTANT))
    step = span / count
    smooth = _SmoothStep(equations, step)
    theta, angle = run.theta, run.psi + inputs.phase
    limit_mean, limit_amplitude = equations.friction_mean, equations.friction_amplitude
    x, v, y, u = run.state.tolist()
    path = array("d", (x, v, y, u, run.friction))
    for index in range(count):
        middle = (index + 0.5) * step
        pulled = load + load_rate * middle
        free_v, free_u = smooth.free(v, y, u, theta + rate * middle, pulled)
        normal = angle + (angle_rate + half * middle) * middle
        limit = step * max(0.0, limit_mean + limit_amplitude * sin(normal))
        impulse = min(limit, max(-limit, free_v / smooth.mobility))
        # Where the impulse stops the slider, it does so exactly: -0.0 and rounding are no slip.
        stopped = abs(impulse) < limit
        next_v = 0.0 if stopped else free_v - smooth.mobility * impulse
        next_u = free_u - smooth.resonator_mobility * impulse
        x += 0.5 * step * (v + next_v)
        y += 0.5 * step * (u + next_u)
        v, u = next_v, next_u
        path.extend((x, v, y, u, impulse / step))
        recorder.slide((v > 0.0) - (v < 0.0))
    recorder.steps += count
    recorder.evaluations += count
    rows = np.array(path).reshape(-1, 5)
    run.state, run.friction = rows[-1, :4], float(rows[-1, 4])
    local = recorder.pending(inputs.stop) - inputs.start
    ends = step * np.arange(count + 1)
    samples = np.column_stack([np.interp(local, ends, column) for column in rows.T])
    run.keep(inputs, local, samples[:, :4], samples[:, 4])


class _SmoothStep:
    """One step of the theta method at 1/2 without friction, and what an impulse does to it.

    The unknowns are the velocities of slider and resonator at the end of the step, from two linear
    equations whose matrix is inverted once.
    """

    def __init__(self, equations: Equations, step: float) -> None:
        e, h = equations, step
        self._equations = e
        self._step = h
        pull = 0.5 * h * (e.coupling_damping + 0.5 * h * e.coupling_stiffness) / e.inertia
        swing = 0.5 * h * (e.damping_rate + 0.5 * h * e.stiffness_rate)
        # v1 - pull u1 = a and v1 + (1 + swing) u1 = b, the second with v' moved to the left.
        self._pull, self._inverse = pull, 1.0 / (1.0 + swing + pull)
        self.mobility = (1.0 + swing) * self._inverse / e.inertia
        self.resonator_mobility = -self._inverse / e.inertia

    def free(self, v: float, y: float, u: float, theta: float, load: float) -> tuple[float, float]:
        """Return both velocities after the step; drive angle and load are those at its middle."""
        e, h = self._equations, self._step
        sine, cosine = sin(theta), sin(theta + 0.5 * pi)
        middle = y + 0.25 * h * u
        force = e.coupling_stiffness * middle + 0.5 * e.coupling_damping * u
        force += e.force_sine * sine + e.force_cosine * cosine - load
        a = v + h * force / e.inertia
        shaken = e.base_acceleration * sine - 0.5 * e.damping_rate * u - e.stiffness_rate * middle
        b = v + u + h * shaken
        after_u = (b - a) * self._inverse
        return a + self._pull * after_u, after_u
