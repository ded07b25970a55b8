"""Integration across the reversals of a slider, without events: by scipy, and in equal steps.

On sgn, as the paper does, the solver loses its order at every reversal and shrinks its steps until
the jump fits the tolerance; in a stick it chatters about zero velocity. On tanh(velocity / width),
the common way to have no events at all, the equations are smooth and stiff: the narrower the width,
the smaller the error and the stiffer the equations; where friction should hold the slider, it
creeps. The bristle of LuGre friction is a fifth state.
"""

from array import array
from collections.abc import Callable, Sequence
from functools import partial
from math import ceil, pi, sin
from typing import Any

import numpy as np
from scipy.integrate import LSODA

from slider_resonator.arrays import Array, Number
from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs, with_steady_phase
from slider_resonator.references.resolved.contact import LIFTED, SLIP_FORWARD
from slider_resonator.references.resolved.equations import equations_of, initial_state
from slider_resonator.references.resolved.trajectory import Recorder, Trajectory

STEPS_PER_FASTEST_PERIOD = 16
"""Longer steps would pass by bristles, and two events within one."""


def simulate(
    device: Device,
    held: Sequence[HeldInputs],
    times: Array,
    *,
    method: Callable[..., Any] = LSODA,
    rtol: float = 1e-11,
    atol: float = 1e-13,
    width: float = 0.0,
    max_evaluations: int = 20_000_000,
) -> Trajectory:
    """Return the motion of a device under held inputs at ``times`` (shape (n,), s).

    Coulomb friction is sgn, or with a ``width`` (m/s) tanh(velocity / width); LuGre friction is
    that of its bristle. ``method`` is a solver of scipy, ``atol`` in fractions of characteristic
    sizes of the states. ``contact_mode`` is the sign of the velocity (2 where the contact is open),
    ``reversal_times`` has NaN for each of its changes between steps, chatter too; there are no
    sticks and no event times. Raises ValueError for times outside the inputs, RuntimeError where a
    step fails or the right hand side is evaluated more than ``max_evaluations`` times.
    """

    def integrate(run: RunWithoutEvents, inputs: HeldInputs) -> None:
        equations, recorder = run.equations, run.recorder
        span = inputs.stop - inputs.start
        scales, longest = equations.state_scales(inputs.load), np.inf
        if equations.path_rate:
            scales = np.append(scales, 1.0 / equations.path_rate)
            longest = 2.0 * np.pi / equations.fastest_rate(inputs, span) / STEPS_PER_FASTEST_PERIOD
        slopes = equations.slopes(None, run.theta, run.psi + inputs.phase, inputs, width)
        given = {"max_step": longest, "rtol": rtol, "atol": atol * scales}
        solver = method(slopes, 0.0, run.state, span, **given)
        while solver.status == "running":
            time = take_step(solver, inputs.start, "use a greater atol")
            evaluations = recorder.evaluations + solver.nfev
            if evaluations > max_evaluations:
                raise RuntimeError(
                    f"{method.__name__} has used {evaluations} evaluations up to t = {time!r} s, "
                    f"max_evaluations = {max_evaluations}: it chatters in a stick; use a greater "
                    "atol, or located events"
                )
            recorder.steps += 1
            load = equations.normal_amplitude * np.sin(run.angles(inputs, float(solver.t)))
            if equations.normal_preload + load > 0.0:
                recorder.slide(int(np.sign(solver.y[1])))
            reached = time if solver.status == "running" else inputs.stop
            local = recorder.pending(reached) - inputs.start
            if local.size:
                states = solver.dense_output()(local).T
                share = np.tanh(states[:, 1] / width) if width else np.sign(states[:, 1])
                run.keep(inputs, local, states, 1.0 if equations.path_rate else share)
        recorder.evaluations += solver.nfev
        run.state = solver.y

    return RunWithoutEvents(device, times).run(held, integrate)


class RunWithoutEvents:
    """A device followed through held inputs; ``theta`` and ``psi`` (rad) are those at their start.

    ``state`` holds position, velocity, resonator displacement and velocity, and with LuGre friction
    the deflection of the bristle, shape (4,) or (5,).
    """

    def __init__(self, device: Device, times: Array) -> None:
        self.recorder = Recorder(times)
        self.device = device
        self.equations = equations_of(device)
        self.state: Array = np.array(initial_state(device))
        self.theta = 0.0
        self.psi = 0.0

    def run(
        self, held: Sequence[HeldInputs], follow: Callable[["RunWithoutEvents", HeldInputs], None]
    ) -> Trajectory:
        """Return the motion through the held inputs, or ones with rates.

        `follow` advances `state` through some, keeping samples and counts.
        """
        for inputs in with_steady_phase(held, self.device):
            self.equations = equations_of(self.device.tuned(inputs.tuned))
            rate, span = self.equations.drive_frequency, inputs.stop - inputs.start
            follow(self, inputs)
            self.theta += rate * span
            self.psi += inputs.turned(span, rate)
        return self.recorder.trajectory()

    def angles(self, inputs: HeldInputs, local: Number) -> Number:
        """Return psi + phase in rad at times in s since the start of the inputs."""
        return self.psi + inputs.phase + inputs.turned(local, self.equations.drive_frequency)

    def keep(self, inputs: HeldInputs, local: Array, states: Array, share: float | Array) -> None:
        """Keep states (k, 4 or 5) at times (k,) in s since the inputs' start.

        ``share`` is that of the friction force in that of forward sliding, NaN where it is unknown.
        """
        equations = self.equations
        theta, angles = self.theta + equations.drive_frequency * local, self.angles(inputs, local)
        normal, friction = equations.contact_forces(SLIP_FORWARD, 0.0, theta, angles, states)
        self.recorder.keep(
            states,
            equations.resonator_motion(theta, states),
            (normal, share * friction),
            np.where(normal > 0.0, np.sign(states[:, 1]), float(LIFTED)),
        )


def take_step(solver: Any, began: float, advice: str) -> float:
    """Take a step of a solver of scipy's that began at a time (s); return the time it reaches.

    Raises RuntimeError, with that time and the advice, if it fails.
    """
    message = solver.step()
    time = began + float(solver.t)
    if solver.status == "failed":
        raise RuntimeError(f"{type(solver).__name__} failed at t = {time!r} s: {message}; {advice}")
    return time


def moreau_jean(
    device: Device, held: Sequence[HeldInputs], times: Array, *, steps_per_period: int
) -> Trajectory:
    """Return the motion by time stepping, with friction as an impulse per step.

    The smooth part is the theta method at 1/2, the friction impulse over a step is the one that
    stops the slider at the end of the step where the friction limit allows that, else the limit.
    Sticking is exact, reversals cost the order: the error falls with the first power of the step.
    The scheme of Moreau (Unilateral contact and dry friction in finite freedom dynamics, 1988) and
    Jean (1999).

    Takes the inputs that ``resolved.simulate`` takes. A step is at most a
    ``steps_per_period``-th of a drive period; those of held inputs are equal, and samples between
    their ends are interpolated linearly. ``contact_mode`` is the sign of the velocity (0 in a
    stick, 2 where the contact is open), ``reversal_times`` has NaN for each of its changes,
    ``friction_force`` is NaN and ``event_times`` empty. Raises ValueError as the other does.
    """
    follow = partial(_step_through, steps_per_period=steps_per_period)
    return RunWithoutEvents(device, times).run(held, follow)


def _step_through(run: RunWithoutEvents, inputs: HeldInputs, *, steps_per_period: int) -> None:
    """Step through held inputs, and keep what is sampled in them."""
    e, recorder = run.equations, run.recorder
    rate, span = e.drive_frequency, inputs.stop - inputs.start
    count = ceil(span * rate / (2.0 * pi) * steps_per_period * (1.0 - 1e-9))  # rounding
    h = span / count
    # The velocities v1, u1 after a step obey v1 - pull u1 = a and v1 + (1 + swing) u1 = b.
    pull = 0.5 * h * (e.coupling_damping + 0.5 * h * e.coupling_stiffness) / e.inertia
    swing = 0.5 * h * (e.damping_rate + 0.5 * h * e.stiffness_rate)
    inverse = 1.0 / (1.0 + swing + pull)
    mobility = (1.0 + swing) * inverse / e.inertia
    resonator_mobility = -inverse / e.inertia
    angle = run.psi + inputs.phase
    x, v, y, u = run.state.tolist()
    path = array("d", run.state)
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
        path.extend((x, v, y, u))
        recorder.slide((v > 0.0) - (v < 0.0))
    recorder.steps += count
    recorder.evaluations += count
    rows = np.array(path).reshape(-1, 4)
    run.state = rows[-1]
    local = recorder.pending(inputs.stop) - inputs.start
    ends = h * np.arange(count + 1)
    samples = np.column_stack([np.interp(local, ends, column) for column in rows.T])
    run.keep(inputs, local, samples, np.nan)
