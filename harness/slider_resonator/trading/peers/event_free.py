"""Integration across the reversals of a slider, without events, by scipy.

On sgn, as the paper does, the solver loses its order at every reversal and shrinks its steps until
the jump fits the tolerance; in a stick it chatters about zero velocity. On tanh(velocity / width),
the common way to have no events at all, the equations are smooth and stiff: the narrower the width,
the smaller the error and the stiffer the equations; where friction should hold the slider, it
creeps. The bristle of LuGre friction is a fifth state.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import Any

import numpy as np
from scipy.integrate import DOP853, LSODA

from slider_resonator.arrays import Array
from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import (
    RATES,
    HeldInputs,
    check_contiguous,
    check_times,
    with_steady_phase,
)
from slider_resonator.references.resolved.contact import LIFTED, SLIP_FORWARD
from slider_resonator.references.resolved.equations import Number, equations_of, initial_state
from slider_resonator.references.resolved.recorder import Recorder
from slider_resonator.references.resolved.trajectory import LugreTrajectory, Trajectory
from slider_resonator.trading.peers.scipy_methods import Method, scipy_method, take_step


class RunWithoutEvents(ABC):
    """A device followed through held inputs; ``theta`` and ``psi`` (rad) are those at their start.

    ``state`` holds position, velocity, resonator displacement and velocity, and with LuGre friction
    the deflection of the bristle, shape (4,) or (5,).
    """

    def __init__(self, device: Device, times: Array, law: int = 0) -> None:
        self.recorder = Recorder(times)
        if device.friction_law != law:
            raise ValueError(f"friction_law = {device.friction_law!r}: only {law} is covered")
        self.device = device
        self.equations = equations_of(device)
        self.state: Array = np.array(initial_state(device))
        self.theta = 0.0
        self.psi = 0.0

    def run(self, held: Sequence[HeldInputs]) -> Trajectory:
        """Return the motion through the held inputs, or ones with rates.

        ``contact_mode`` is the sign of the velocity (2 where the contact is open), ``reversals``
        counts its changes of sign between steps; there are no event times. Raises ValueError for
        inputs with gaps and times outside them, besides what the method raises.
        """
        check_contiguous(held, rates=RATES)
        check_times(self.recorder.times, held)
        for inputs in with_steady_phase(held, self.device):
            device = inputs.tuned_device(self.device)
            if device is not self.device:
                self.equations = equations_of(device)
            rate = self.equations.drive_frequency
            self.follow(inputs)
            span = inputs.stop - inputs.start
            self.theta += rate * span
            self.psi += inputs.turned(span, rate)
        return self.recorder.trajectory()

    @abstractmethod
    def follow(self, inputs: HeldInputs) -> None:
        """Advance ``state`` through held inputs, keeping samples and counts."""

    def angles(self, inputs: HeldInputs, local: Number) -> Number:
        """Return psi + phase in rad at times in s since the start of the inputs."""
        ratio = inputs.frequency_ratio + 0.5 * inputs.ratio_rate * local
        return self.psi + inputs.phase + ratio * self.equations.drive_frequency * local

    def keep(self, inputs: HeldInputs, local: Array, states: Array, friction: Array) -> None:
        """Keep states (k, 4 or 5) and friction (k,) in N at times in s since the inputs' start."""
        equations = self.equations
        angles = self.angles(inputs, local)
        load = equations.normal_preload + equations.normal_amplitude * np.sin(angles)
        self.recorder.keep(
            states,
            equations.resonator_motion(self.theta + equations.drive_frequency * local, states),
            (np.maximum(0.0, load), friction),
            np.where(load > 0.0, np.sign(states[:, 1]), float(LIFTED)),
            states[:, 4] if states.shape[1] > 4 else None,
        )


MAX_EVALUATIONS = 20_000_000
STEPS_PER_FASTEST_PERIOD = 16
"""Of bristles, which a longer step would pass by."""


def simulate_sgn(
    device: Device,
    held: Sequence[HeldInputs],
    times: Array,
    *,
    rtol: float = 1e-6,
    atol: float = 1e-10,
    max_evaluations: int = MAX_EVALUATIONS,
) -> Trajectory:
    """Return the trajectory by the paper's own method, DOP853 on sgn, at ``times`` (shape (n,), s).

    ``atol`` is in fractions of a characteristic velocity and displacement; the cost of stepping
    over a jump depends on it. A chatter may take ``max_evaluations`` of the right hand side.
    Counts, modes and errors raised are those of ``_Run``.
    """
    return _Run(device, times, DOP853, rtol, atol, max_evaluations=max_evaluations).run(held)


def simulate_tanh(
    device: Device,
    held: Sequence[HeldInputs],
    times: Array,
    *,
    width: float,
    rtol: float = 1e-9,
    atol: float = 1e-11,
) -> Trajectory:
    """Return the trajectory with tanh(velocity / ``width``) at ``times`` (shape (n,), s).

    LSODA takes ``width`` in m/s, and ``atol`` in fractions of a characteristic velocity and
    displacement. Counts and modes are those of ``_Run``, and so are errors raised, besides
    ValueError for a width that is not above 0.
    """
    if not 0.0 < width < np.inf:
        raise ValueError(f"width = {width!r} m/s: must be a finite number above 0")
    return _Run(device, times, LSODA, rtol, atol, width).run(held)


def simulate_bristle(
    device: Device,
    held: Sequence[HeldInputs],
    times: Array,
    *,
    method: str = "LSODA",
    rtol: float = 1e-11,
    atol: float = 1e-13,
) -> LugreTrajectory:
    """Return the trajectory with LuGre friction, the bristle a state, at ``times`` (shape (n,), s).

    ``method`` is LSODA, Radau or, for soft bristles, DOP853, ``atol`` in fractions of
    characteristic sizes of the states. Counts and modes are those of ``_Run``, and so are errors
    raised, besides ValueError for another method.
    """
    run = _Run(device, times, scipy_method(method), rtol, atol, law=1)
    run.run(held)
    return run.recorder.lugre_trajectory()


class _Run(RunWithoutEvents):
    """A solver of scipy's; ``width`` (m/s) is that of tanh, 0 for sgn and for bristles.

    There are no sticks; reversals are counted over the steps with contact, chatter included.
    Raises RuntimeError if a step fails or the evaluations of the right hand side become too many.
    """

    def __init__(
        self,
        device: Device,
        times: Array,
        method: Method,
        rtol: float,
        atol: float,
        width: float = 0.0,
        max_evaluations: int = MAX_EVALUATIONS,
        law: int = 0,
    ) -> None:
        super().__init__(device, times, law)
        self._method = method
        self._rtol = rtol
        self._atol = atol
        self._width = width
        self._max_evaluations = max_evaluations

    def follow(self, inputs: HeldInputs) -> None:
        equations, recorder = self.equations, self.recorder
        scales, bounds = equations.state_scales(inputs.load), {}
        if equations.path_rate:
            scales = np.append(scales, 1.0 / equations.path_rate)
            later = inputs.later(inputs.stop - inputs.start).frequency_ratio
            fastest = equations.fastest_rate(max(inputs.frequency_ratio, later, key=abs))
            bounds = {"max_step": 2.0 * np.pi / fastest / STEPS_PER_FASTEST_PERIOD}
        solver = self._method(
            equations.slopes(
                *(None, inputs.load, self.theta, self.psi + inputs.phase, inputs.frequency_ratio),
                self._width,
                load_rate=inputs.load_rate,
                ratio_rate=inputs.ratio_rate,
            ),
            0.0,
            self.state,
            inputs.stop - inputs.start,
            rtol=self._rtol,
            atol=self._atol * scales,
            **bounds,
        )
        while solver.status == "running":
            take_step(solver, inputs.start, "use a greater atol")
            self._check_progress(solver, inputs.start)
            recorder.steps += 1
            velocity = float(solver.y[1])
            load = equations.normal_amplitude * np.sin(self.angles(inputs, float(solver.t)))
            if equations.normal_preload + load > 0.0:
                recorder.contact.slide((velocity > 0.0) - (velocity < 0.0))
            reached = inputs.start + solver.t if solver.status == "running" else inputs.stop
            local = recorder.pending(reached) - inputs.start
            if local.size:
                states = solver.dense_output()(local).T
                self.keep(inputs, local, states, self._friction(inputs, local, states))
        recorder.evaluations += solver.nfev
        self.state = solver.y

    def _check_progress(self, solver: Any, start: float) -> None:
        evaluations = self.recorder.evaluations + solver.nfev
        if evaluations > self._max_evaluations:
            time = start + float(solver.t)
            raise RuntimeError(
                f"{type(solver).__name__} has used {evaluations} evaluations up to t = {time!r} s, "
                f"max_evaluations = {self._max_evaluations}: it chatters in a stick; use a "
                "greater atol, or located events"
            )

    def _friction(self, inputs: HeldInputs, local: Array, states: Array) -> Array:
        angles, velocity = self.angles(inputs, local), states[:, 1]
        if self.equations.path_rate:
            _, friction = self.equations.contact_forces(SLIP_FORWARD, 0.0, angles, angles, states)
            return friction
        limit = np.maximum(0.0, self.equations.friction_limit(angles))
        share = np.tanh(velocity / self._width) if self._width else np.sign(velocity)
        return np.asarray(share * limit)
