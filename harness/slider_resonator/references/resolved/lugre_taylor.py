"""The LuGre reference: heyoka's Taylor method, bristles from the path, reversals located.

Between two reversals the bristle is an explicit function of the path, so that stiff bristles do not
make the equations stiff. For comparison the bristle can be integrated as a state instead, which
costs steps in proportion to its stiffness.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Literal

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import (
    RATES,
    HeldInputs,
    check_contiguous,
    check_times,
    check_turns_on,
    with_steady_phase,
)
from slider_resonator.references.phase import Elapsed, advanced
from slider_resonator.references.resolved.contact import LIFTED, is_lifted, time_to_contact_change
from slider_resonator.references.resolved.equations import initial_state
from slider_resonator.references.resolved.lugre_equations import lugre_equations_of
from slider_resonator.references.resolved.polynomial_roots import first_fall
from slider_resonator.references.resolved.recorder import Recorder
from slider_resonator.references.resolved.taylor_system import (
    BRISTLE,
    DIRECTION,
    DRIVE_AND_NORMAL_ANGLE,
    HELD,
    LOAD_AND_RATIO_RATES,
    ROUNDING,
    ROUNDING_OF_A_SUM,
    STRETCH_AND_SHORTFALL,
    held_parameters,
    rate_parameters,
    scales_of,
    series_values,
    taylor_integrator,
)
from slider_resonator.references.resolved.trajectory import LugreTrajectory

Bristle = Literal["path", "state"]
"""Whether the bristle follows from the path since the start of a step, or is a state."""

_FORGOTTEN = 1e-25
_MAX_EVENTS_AT_ONE_INSTANT = 20


def simulate_lugre(
    device: Device,
    held: Sequence[HeldInputs],
    times: Array,
    *,
    bristle: Bristle = "path",
    tolerance: float = ROUNDING,
) -> LugreTrajectory:
    """Return the motion with LuGre friction (8) under held inputs at ``times`` (shape (n,), s).

    ``times`` ascend within ``[held[0].start, held[-1].stop]``; theta and psi are 0 at the first
    start. A sample on a boundary between inputs belongs to the inputs before it. ``bristle`` says
    whether its deflection is taken from the path, or integrated as a state: slow above a
    bristle_stiffness of 1e5 1/m. ``tolerance`` is that of a Taylor step in the scaled variables.
    Counts cover the whole span of the inputs. ``evaluations`` counts Taylor expansions. Raises
    ValueError for a device that ``lugre_equations_of`` does not cover, inputs with gaps, and times
    outside them; RuntimeError for a motion that leaves the finite numbers; ModuleNotFoundError when
    heyoka is not installed.
    """
    check_contiguous(held, rates=RATES)
    check_times(times, held)
    run = _Run(device, times, bristle, tolerance)
    for inputs in with_steady_phase(held, device):
        check_turns_on(inputs)
        run.follow(inputs)
    return run.recorder.lugre_trajectory()


class _Run:
    """The motion through held inputs: drive angle as time, forces over a characteristic force.

    ``_stretch`` is s0 z / mu; ``_shortfall`` is its difference from the stretch of steady sliding
    in the present direction, kept apart because it decays far below the rounding of the stretch.
    """

    def __init__(self, device: Device, times: Array, bristle: Bristle, tolerance: float) -> None:
        self.recorder = Recorder(times)
        self._device = device
        self._lugre = lugre = lugre_equations_of(device)
        self._equations = lugre.equations
        self._from_path = bristle == "path"
        self._bristle, self._tolerance = bristle, tolerance
        self._position, velocity, *resonator = initial_state(device)
        self._motion = np.array([0.0, velocity, *resonator])
        self._stretch = device.initial_bristle_deflection / lugre.max_deflection
        self._direction = -1 if velocity < 0.0 else 1
        self._shortfall = self._direction - self._stretch
        self._theta = 0.0
        self._psi = 0.0

    def follow(self, inputs: HeldInputs) -> None:
        self._tune(inputs)
        equations = self._equations
        rate = equations.drive_frequency
        varies = bool(inputs.load_rate or inputs.ratio_rate)
        self._integrator = taylor_integrator(self._bristle, self._tolerance, rates=varies)
        force, self._scales = scales_of(equations, inputs.load)
        self._integrator.pars[BRISTLE] = (
            self._lugre.path_rate * self._scales[0],
            self._lugre.path_damping * self._scales[1],
        )
        friction = equations.friction_mean + equations.friction_amplitude
        self._driving_share = 1.0 - friction / force
        self._force = force
        span = (inputs.stop - inputs.start) * rate
        load_of = equations.normal_preload, equations.normal_amplitude
        chirp = inputs.ratio_rate / rate
        lifted = is_lifted(*load_of, self._psi + inputs.phase, inputs.frequency_ratio)
        elapsed = Elapsed()
        while (remaining := elapsed.until(span)) > 0.0:
            now = self._present(inputs, elapsed)
            change = time_to_contact_change(
                lifted, *load_of, self._psi + now.phase, now.frequency_ratio, chirp
            )
            self._follow_contact(inputs, lifted, elapsed, min(change, remaining))
            lifted = lifted != (change < remaining)
        # A last step that ends short of the stop by rounding has not covered samples there.
        still = np.append(self._motion / self._scales, self._stretch)[:, np.newaxis]
        missed = np.zeros(len(self.recorder.pending(inputs.stop)))
        end = self._present(inputs, elapsed)
        self._keep(end, LIFTED if lifted else self.recorder.contact.direction, missed, still)

    def _present(self, inputs: HeldInputs, elapsed: Elapsed) -> HeldInputs:
        """Return the inputs as they are after a scaled time."""
        passed = (elapsed.seconds + elapsed.carry) / self._equations.drive_frequency
        return inputs.later(passed) if inputs.vary else inputs

    def _tune(self, inputs: HeldInputs) -> None:
        """Take the device as it is over these inputs; the deflection of the bristle stays."""
        before = self._lugre
        self._lugre = lugre_equations_of(inputs.tuned_device(self._device))
        self._equations = self._lugre.equations
        if self._lugre.max_deflection != before.max_deflection:
            self._stretch *= before.max_deflection / self._lugre.max_deflection
            self._shortfall = self._direction - self._stretch

    def _follow_contact(
        self, inputs: HeldInputs, lifted: bool, elapsed: Elapsed, span: float
    ) -> None:
        """Follow an open or a closed contact for a scaled span."""
        rate = self._equations.drive_frequency
        within = Elapsed()
        events = 0
        while (remaining := within.until(span)) > 0.0:
            now = self._present(inputs, elapsed)
            self._integrator.pars[HELD] = held_parameters(
                self._equations,
                now.load,
                now.frequency_ratio,
                self._force,
                LIFTED if lifted else None,
            )
            if now.vary:
                self._integrator.pars[LOAD_AND_RATIO_RATES] = rate_parameters(
                    self._equations, now.load_rate, now.ratio_rate, self._force
                )
            step, fell, coefficients = self._expand(remaining, now.phase)
            events = events + 1 if fell and step <= math.ulp(1.0) else 0
            start = elapsed.seconds + elapsed.carry
            if events > _MAX_EVENTS_AT_ONE_INSTANT:
                raise RuntimeError(
                    f"the velocity at t = {inputs.start + start / rate!r} s changes sign more than "
                    f"{_MAX_EVENTS_AT_ONE_INSTANT} times at one instant: the motion there is "
                    "below rounding; perturb the initial state or an input"
                )
            if step > 0.0:
                mode = LIFTED if lifted else self._direction
                self.recorder.contact.slide(self._direction, inputs.start + start / rate)
                self.recorder.contact.enter(mode, inputs.start + start / rate)
                local = (self.recorder.pending(inputs.stop) - inputs.start) * rate - start
                stop = (inputs.stop - inputs.start) * rate - start
                covered = len(local)
                if step < stop:
                    covered = int(np.searchsorted(local, step, side="right"))
                self._keep(now, mode, np.clip(local[:covered], 0.0, step), coefficients)
                self._advance(step, now, coefficients)
                elapsed.add(step)
                within.add(step)
            if fell:
                self._motion[1] = 0.0
                self._direction = -self._direction
                self._shortfall = self._direction - self._stretch

    def _expand(self, longest: float, phase: float) -> tuple[float, bool, Array]:
        """Return a scaled step, whether the velocity falls to zero at its end, and the series."""
        integrator = self._integrator
        integrator.pars[DRIVE_AND_NORMAL_ANGLE] = self._theta, self._psi + phase
        # The path starts from zero, so that a long way travelled costs it no digits.
        integrator.state[:4] = self._motion / self._scales
        integrator.pars[DIRECTION] = self._direction
        if self._from_path:
            integrator.pars[STRETCH_AND_SHORTFALL] = self._stretch, self._shortfall
        else:
            integrator.state[4] = self._stretch
        integrator.time = 0.0
        _, step = integrator.step(max_delta_t=longest, write_tc=True)
        coefficients: Array = np.array(integrator.tc)
        self.recorder.steps += 1
        self.recorder.evaluations += 1
        if not (step > 0.0 and np.isfinite(coefficients).all()):
            raise RuntimeError(
                f"the Taylor step from velocity {self._motion[1]!r} m/s is {step!r}: "
                "the motion has left the finite numbers"
            )
        fall = first_fall(
            self._direction * coefficients[1], step, self._noise(coefficients[:4], step)
        )
        return (step, False, coefficients) if fall is None else (fall, True, coefficients)

    def _noise(self, coefficients: Array, step: float) -> float:
        """Return the rounding error of the velocity in a step, over its scale."""
        lugre, equations = self._lugre, self._equations
        rate = equations.drive_frequency
        terms = np.abs(coefficients * step ** np.arange(coefficients.shape[1]))
        speed_share = float(terms[1].max())
        speed = float(self._scales[1]) * speed_share
        path = speed * min(step, 1.0) / rate
        # What the bristle holds in presliding is far below its limit, and so is its rounding.
        grip = abs(self._stretch) + (1.0 + abs(self._stretch)) * (
            min(1.0, lugre.path_rate * path) + lugre.path_damping * speed
        )
        coupling = equations.coupling_damping + equations.coupling_stiffness / rate
        force = (
            self._driving_share
            + (1.0 - self._driving_share) * grip
            + coupling / (equations.inertia * rate) * float(terms[2:].max())
        )
        return ROUNDING_OF_A_SUM * (speed_share + min(step, 1.0) * force)

    def _stretched(self, path: Array, local: Array, coefficients: Array) -> tuple[Array, Array]:
        """Return stretch and shortfall where the scaled path and time have the given values."""
        if not self._from_path:
            stretch = series_values(local, coefficients[4:])[:, 0]
            return stretch, self._direction - stretch
        exponent = -self._lugre.path_rate * self._scales[0] * self._direction * path
        return (
            self._stretch - self._shortfall * np.expm1(exponent),
            self._shortfall * np.exp(exponent),
        )

    def _keep(self, inputs: HeldInputs, mode: int, local: Array, coefficients: Array) -> None:
        lugre, equations = self._lugre, self._equations
        scaled = series_values(local, coefficients[:4])
        stretch, _ = self._stretched(scaled[:, 0], local, coefficients)
        states = scaled * self._scales
        states[:, 0] += self._position
        rate = equations.drive_frequency
        half = 0.5 * inputs.ratio_rate / rate
        angle = self._psi + inputs.phase + (inputs.frequency_ratio + half * local) * local
        load = inputs.load + inputs.load_rate / rate * local
        resonator = equations.resonator_motion(self._theta + local, states)
        forces = equations.contact_forces(mode, load, self._theta + local, angle, states)
        if mode != LIFTED:
            forces = forces[0], lugre.friction_force(states[:, 1], stretch, angle)
        deflection = lugre.max_deflection * stretch
        self.recorder.keep(states, resonator, forces, mode, deflection)

    def _advance(self, step: float, inputs: HeldInputs, coefficients: Array) -> None:
        local = np.array([step])
        end = series_values(local, coefficients[:4])[0]
        stretch, shortfall = self._stretched(end[:1], local, coefficients)
        self._stretch = float(stretch[0])
        self._shortfall = float(shortfall[0]) if abs(shortfall[0]) > _FORGOTTEN else 0.0
        self._motion = end * self._scales
        self._position += float(self._motion[0])
        self._motion[0] = 0.0
        self._theta = advanced(self._theta, step)
        half = 0.5 * inputs.ratio_rate / self._equations.drive_frequency
        self._psi = advanced(self._psi, (inputs.frequency_ratio + half * step) * step)
