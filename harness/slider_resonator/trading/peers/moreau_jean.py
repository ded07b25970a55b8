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
    e, recorder = run.equations, run.recorder
    rate, span = e.drive_frequency, inputs.stop - inputs.start
    count = ceil(span * rate / (2.0 * pi) * steps_per_period * (1.0 - _SAME_INSTANT))
    h = span / count
    # The velocities v1, u1 after a step obey v1 - pull u1 = a and v1 + (1 + swing) u1 = b.
    pull = 0.5 * h * (e.coupling_damping + 0.5 * h * e.coupling_stiffness) / e.inertia
    swing = 0.5 * h * (e.damping_rate + 0.5 * h * e.stiffness_rate)
    inverse = 1.0 / (1.0 + swing + pull)
    mobility = (1.0 + swing) * inverse / e.inertia
    resonator_mobility = -inverse / e.inertia
    angle = run.psi + inputs.phase
    x, v, y, u = run.state.tolist()
    path = array("d", (x, v, y, u, run.friction))
    for index in range(count):
        middle = (index + 0.5) * h
        theta = run.theta + rate * middle
        sine, cosine = sin(theta), sin(theta + 0.5 * pi)
        stretched = y + 0.25 * h * u
        force = e.coupling_stiffness * stretched + 0.5 * e.coupling_damping * u
        force += e.force_sine * sine + e.force_cosine * cosine
        force -= inputs.load + inputs.load_rate * middle
        shaken = e.base_acceleration * sine - 0.5 * e.damping_rate * u
        a = v + h * force / e.inertia
        b = v + u + h * (shaken - e.stiffness_rate * stretched)
        free_u = (b - a) * inverse
        free_v = a + pull * free_u
        normal = angle + inputs.turned(middle, rate)
        limit = h * max(0.0, e.friction_mean + e.friction_amplitude * sin(normal))
        impulse = min(limit, max(-limit, free_v / mobility))
        # Where the impulse stops the slider, it does so exactly: -0.0 and rounding are no slip.
        next_v = 0.0 if abs(impulse) < limit else free_v - mobility * impulse
        next_u = free_u - resonator_mobility * impulse
        x += 0.5 * h * (v + next_v)
        y += 0.5 * h * (u + next_u)
        v, u = next_v, next_u
        path.extend((x, v, y, u, impulse / h))
        recorder.slide((v > 0.0) - (v < 0.0))
    recorder.steps += count
    recorder.evaluations += count
    rows = np.array(path).reshape(-1, 5)
    run.state, run.friction = rows[-1, :4], float(rows[-1, 4])
    local = recorder.pending(inputs.stop) - inputs.start
    ends = h * np.arange(count + 1)
    samples = np.column_stack([np.interp(local, ends, column) for column in rows.T])
    run.keep(inputs, local, samples[:, :4], samples[:, 4])
