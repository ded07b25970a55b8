"""LuGre friction by scipy on the full state.

The bristle is integrated as it stands in (8), |v| and the open contact are not treated as events.
An implicit method, because stiff bristles are stiff here.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from scipy.optimize import brentq

from slider_resonator.arrays import Array
from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import (
    RATES,
    HeldInputs,
    check_contiguous,
    check_times,
    turning_apart,
    with_steady_phase,
)
from slider_resonator.references.resolved.contact import (
    LIFTED,
    SLIP_FORWARD,
    is_lifted,
    time_to_contact_change,
)
from slider_resonator.references.resolved.contact_record import ContactRecord
from slider_resonator.references.resolved.equations import equations_of, initial_state
from slider_resonator.references.resolved.recorder import Recorder
from slider_resonator.references.resolved.trajectory import LugreTrajectory
from slider_resonator.trade.peers.scipy_methods import Method, scipy_method, take_step

_STEPS_PER_FASTEST_PERIOD = 16


def simulate_lugre(
    device: Device,
    held: Sequence[HeldInputs],
    times: Array,
    *,
    method: str = "LSODA",
    rtol: float = 1e-11,
    atol: float = 1e-13,
) -> LugreTrajectory:
    """Return the motion with LuGre friction (8) under held inputs at ``times`` (shape (n,), s).

    Takes the inputs that ``resolved.simulate`` takes. ``method`` is LSODA, Radau
    or, for soft bristles, DOP853, ``atol`` is in fractions of characteristic sizes of the states.
    Reversals are looked for between the ends of steps, and located in the dense output. Raises
    ValueError as the other does, and for another method; RuntimeError if a step fails.
    """
    solver = scipy_method(method)
    check_contiguous(held, rates=RATES)
    check_times(times, held)
    run = _Run(device, times)
    for inputs in turning_apart(with_steady_phase(held, device)):
        run.follow(inputs, solver, rtol, atol)
    return run.recorder.lugre_trajectory()


class _Run:
    """The state (position, velocity, Y, Y', z) of a run between held inputs, samples and counts."""

    def __init__(self, device: Device, times: Array) -> None:
        self.recorder = Recorder(times)
        self._start = self._device = device
        self._equations = equations_of(device)
        self._state = np.array(initial_state(device))
        self._theta = 0.0
        self._psi = 0.0

    def follow(self, inputs: HeldInputs, method: Method, rtol: float, atol: float) -> None:
        self._device = inputs.tuned_device(self._start)
        self._equations = equations = equations_of(self._device)
        span = inputs.stop - inputs.start
        ratio = max(inputs.frequency_ratio, inputs.later(span).frequency_ratio, key=abs)
        scales = np.append(equations.state_scales(inputs.load), 1.0 / equations.path_rate)
        start = self._state[0]
        events = _Events(self.recorder.contact, self._switches(inputs), inputs.start)
        solver = method(
            self._slopes(inputs),
            0.0,
            np.array([0.0, *self._state[1:]]),
            inputs.stop - inputs.start,
            max_step=2.0 * math.pi / equations.fastest_rate(ratio) / _STEPS_PER_FASTEST_PERIOD,
            rtol=rtol,
            atol=atol * scales,
        )
        while solver.status == "running":
            take_step(solver, inputs.start, "use a greater rtol")
            self.recorder.steps += 1
            events.follow(solver)
            reached = inputs.start + solver.t if solver.status == "running" else inputs.stop
            local = self.recorder.pending(reached) - inputs.start
            if local.size:
                states = solver.dense_output()(local).T
                states[:, 0] += start
                self._keep(inputs, local, states)
        events.finish(inputs.stop - inputs.start)
        self.recorder.evaluations += solver.nfev
        turned = equations.drive_frequency * (inputs.stop - inputs.start)
        self._theta += turned
        self._psi += inputs.turned(inputs.stop - inputs.start, equations.drive_frequency)
        self._state = solver.y
        self._state[0] += start

    def _switches(self, inputs: HeldInputs) -> tuple[bool, list[float]]:
        """Return whether the contact is open at first, and when it lifts and touches down (s).

        Times are since the inputs are held.
        """
        equations = self._equations
        load = equations.normal_preload, equations.normal_amplitude
        frequency = equations.drive_frequency
        span = inputs.stop - inputs.start
        chirp = inputs.ratio_rate * frequency

        def turning(time: float) -> tuple[float, float, float]:
            angle = self._psi + inputs.phase + inputs.turned(time, frequency)
            return angle, inputs.frequency_ratio * frequency + chirp * time, chirp

        first = lifted = is_lifted(*load, *turning(0.0)[:2])
        times: list[float] = []
        time = 0.0
        while (time := time + time_to_contact_change(lifted, *load, *turning(time))) < span:
            times.append(time)
            lifted = not lifted
        return first, times

    def _slopes(self, inputs: HeldInputs) -> Callable[[float, Array], list[float]]:
        equations = self._equations
        sin, cos = math.sin, math.cos
        theta, angle = self._theta, self._psi + inputs.phase
        rate = equations.drive_frequency
        angle_rate, half = inputs.frequency_ratio * rate, 0.5 * inputs.ratio_rate * rate
        preload, amplitude = equations.normal_preload, equations.normal_amplitude
        faces, coefficient = self._device.friction_faces, self._device.friction_coefficient
        stiffness, damping = self._device.bristle_stiffness, self._device.bristle_damping

        load, load_rate = inputs.load, inputs.load_rate
        force_sine, force_cosine = equations.force_sine, equations.force_cosine
        coupling, spring = equations.coupling_damping, equations.coupling_stiffness
        inertia, base = equations.inertia, equations.base_acceleration
        damping_rate, stiffness_rate = equations.damping_rate, equations.stiffness_rate

        def slopes(time: float, state: Array) -> list[float]:
            _, velocity, displacement, resonator_velocity, deflection = state.tolist()
            deflection_rate = velocity - stiffness * abs(velocity) * deflection / coefficient
            normal = max(0.0, preload + amplitude * sin(angle + (angle_rate + half * time) * time))
            sine = sin(theta + rate * time)
            acceleration = (
                coupling * resonator_velocity
                + spring * displacement
                + force_sine * sine
                + force_cosine * cos(theta + rate * time)
                - (load + load_rate * time)
                - faces * normal * (stiffness * deflection + damping * deflection_rate)
            ) / inertia
            resonator = (
                base * sine
                - damping_rate * resonator_velocity
                - stiffness_rate * displacement
                - acceleration
            )
            return [velocity, acceleration, resonator_velocity, resonator, deflection_rate]

        return slopes

    def _keep(self, inputs: HeldInputs, time: Array, states: Array) -> None:
        equations = self._equations
        theta = self._theta + equations.drive_frequency * time
        rate, half = equations.drive_frequency, 0.5 * inputs.ratio_rate
        angle = self._psi + inputs.phase + (inputs.frequency_ratio + half * time) * rate * time
        load = equations.normal_preload + equations.normal_amplitude * np.sin(angle)
        self.recorder.keep(
            states,
            equations.resonator_motion(theta, states),
            equations.contact_forces(SLIP_FORWARD, inputs.load, theta, angle, states),
            np.where(load > 0.0, np.sign(states[:, 1]), float(LIFTED)),
            states[:, 4],
        )


class _Events:
    """Enters contact modes and reversals, in the order of their times, while inputs are held."""

    def __init__(
        self, contact: ContactRecord, switches: tuple[bool, list[float]], start: float
    ) -> None:
        self._contact = contact
        self._lifted, self._switches = switches
        self._start = start

    def follow(self, solver: Any) -> None:
        """Search a step of a solver for events."""
        reached = solver.y.item(1)
        direction = (reached > 0.0) - (reached < 0.0)
        if direction * self._contact.direction < 0:
            dense = solver.dense_output()

            def velocity(time: float) -> float:
                return float(dense(time)[1])

            begin, end = solver.t_old, solver.t
            turned = begin
            if velocity(begin) * velocity(end) < 0.0:
                turned = brentq(velocity, begin, end, xtol=1e-18, rtol=1e-15)
            self._move(turned)
            self._enter(direction, turned)
        else:
            self._enter(direction, solver.t_old)
            self._move(solver.t)

    def finish(self, time: float) -> None:
        """Enter the remaining events up to a time (s) since the inputs are held."""
        self._move(time)

    def _move(self, time: float) -> None:
        while self._switches and self._switches[0] <= time:
            switch = self._switches.pop(0)
            self._lifted = not self._lifted
            self._enter(self._contact.direction, switch)

    def _enter(self, direction: int, time: float) -> None:
        self._contact.slide(direction, self._start + time)
        self._contact.enter(LIFTED if self._lifted else direction, self._start + time)
