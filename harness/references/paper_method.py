"""The paper's own method: DOP853 straight through the discontinuities of sgn, no events.

At every reversal the method loses its order and shrinks its steps until the jump fits the
tolerance; in a stick it chatters about zero velocity. It is here for comparison of cost and error.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import DOP853

from harness.references.contact import LIFTED
from harness.references.device import Device
from harness.references.equations import Equations, equations_of, initial_state
from harness.references.held_inputs import HeldInputs, check_contiguous, check_times
from harness.references.trajectory import Trajectory

Array = NDArray[np.float64]


def simulate(
    device: Device,
    held: Sequence[HeldInputs],
    times: Array,
    *,
    rtol: float = 1e-6,
    atol: float = 1e-10,
    most_evaluations: int = 20_000_000,
) -> Trajectory:
    """Return the motion of a device under held inputs at ``times`` (shape (n,), s).

    Takes the inputs that ``located_events.simulate`` takes; ``atol`` is in fractions of a
    characteristic velocity and displacement, and the cost of stepping over a jump hangs on it.
    Without events there is no stick: ``contact_mode`` is the sign of the velocity (2 where the
    contact is open), ``reversals`` counts its changes of sign over the steps with contact, chatter
    included, ``sticks`` and ``stick_time`` are 0 and ``event_times`` is empty. Raises ValueError
    as ``located_events.simulate`` does, RuntimeError if a step fails or a chatter takes more than
    ``most_evaluations`` of the right hand side.
    """
    check_contiguous(held)
    check_times(times, held)
    run = _Run(equations_of(device), initial_state(device), times, most_evaluations)
    for inputs in held:
        run.follow(inputs, rtol, atol)
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
        sticks=0,
        stick_time=0.0,
        event_times=np.empty(0),
        steps=run.steps,
        evaluations=run.evaluations,
    )


class _Run:
    """The state of a run between held inputs, with its samples and counts."""

    def __init__(
        self,
        equations: Equations,
        state: tuple[float, float, float, float],
        times: Array,
        most_evaluations: int,
    ) -> None:
        self.signals = np.empty((len(times), 7))
        self.reversals = 0
        self.steps = 0
        self.evaluations = 0
        self._most_evaluations = most_evaluations
        self._equations = equations
        self._state = np.array(state)
        self._times = times
        self._kept = 0
        self._theta = 0.0
        self._psi = 0.0
        self._slip = 0

    def follow(self, inputs: HeldInputs, rtol: float, atol: float) -> None:
        equations = self._equations
        angle = self._psi + inputs.phase
        solver = DOP853(
            equations.slopes(None, inputs.load, self._theta, angle, inputs.frequency_ratio),
            0.0,
            self._state,
            inputs.stop - inputs.start,
            rtol=rtol,
            atol=atol * equations.state_scales(inputs.load),
        )
        while solver.status == "running":
            message = solver.step()
            self._check_progress(solver, inputs.start, message)
            self.steps += 1
            self._count_reversal(angle + self._angle_rate(inputs) * solver.t, float(solver.y[1]))
            reached = inputs.start + solver.t if solver.status == "running" else inputs.stop
            until = int(np.searchsorted(self._times, reached, side="right"))
            if until > self._kept:
                local = self._times[self._kept : until] - inputs.start
                states = solver.dense_output()(local).T
                self.signals[self._kept : until] = self._signals(inputs, angle, local, states)
                self._kept = until
        self.evaluations += solver.nfev
        turned = equations.drive_frequency * (inputs.stop - inputs.start)
        self._theta += turned
        self._psi += inputs.frequency_ratio * turned
        self._state = solver.y

    def _check_progress(self, solver: DOP853, start: float, message: str | None) -> None:
        time = start + float(solver.t)
        if solver.status == "failed":
            raise RuntimeError(f"DOP853 failed at t = {time!r} s: {message}; use a greater atol")
        if self.evaluations + solver.nfev > self._most_evaluations:
            raise RuntimeError(
                f"DOP853 has used {self.evaluations + solver.nfev} evaluations up to t = "
                f"{time!r} s, most_evaluations = {self._most_evaluations}: it chatters in a stick; "
                "use a greater atol, or located_events"
            )

    def _count_reversal(self, angle: float, velocity: float) -> None:
        equations = self._equations
        if equations.normal_preload + equations.normal_amplitude * np.sin(angle) <= 0.0:
            return
        slip = (velocity > 0.0) - (velocity < 0.0)
        if slip:
            self.reversals += self._slip == -slip
            self._slip = slip

    def _signals(self, inputs: HeldInputs, angle: float, time: Array, states: Array) -> Array:
        equations = self._equations
        theta = self._theta + equations.drive_frequency * time
        angles = angle + self._angle_rate(inputs) * time
        load = equations.normal_preload + equations.normal_amplitude * np.sin(angles)
        sign = np.sign(states[:, 1])
        return np.column_stack(
            [
                states[:, :2],
                *equations.resonator_motion(theta, states),
                np.maximum(0.0, load),
                sign * np.maximum(0.0, equations.friction_limit(angles)),
                np.where(load > 0.0, sign, float(LIFTED)),
            ]
        )

    def _angle_rate(self, inputs: HeldInputs) -> float:
        return inputs.frequency_ratio * self._equations.drive_frequency
