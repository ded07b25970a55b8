"""The dimensional equations of motion (26)-(27) of one device, and of its fidelity 1 form."""

import cmath
import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from slider_resonator.arrays import Array, Number
from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.equivalent_force import steady_vibration
from slider_resonator.references.resolved.contact import LIFTED, STICK

State = tuple[float, ...]
"""Position m, velocity m/s, resonator displacement m and velocity m/s; with LuGre friction also the
deflection of the bristle, m."""


@dataclass(frozen=True)
class Equations:
    """Coefficients, in SI units, of the motion between two events.

    With ``s`` the slip direction, theta the drive angle and psi the angle of the normal load::

        inertia X'' = needed_force - s (friction_mean + friction_amplitude sin psi)
        needed_force = coupling_damping Y' + coupling_stiffness Y
                       + force_sine sin theta + force_cosine cos theta - load
        Y'' = base_acceleration sin theta - damping_rate Y' - stiffness_rate Y - X''

    In fidelity 1 the force terms carry the whole vibration, ``steady_resonator`` is the complex
    amplitude of the resonator, Im(steady_resonator e^{i theta}), and the Y of these equations is
    an idle state without any effect on X.

    With LuGre friction (8), ``path_rate`` > 0, the bristle has the stretch W = path_rate z, 1 in
    steady sliding, and the friction is that at W + path_damping |X'| (s - W) in place of s::

        W' = path_rate |X'| (s - W)
    """

    drive_frequency: float
    inertia: float
    friction_mean: float
    friction_amplitude: float
    normal_preload: float
    normal_amplitude: float
    force_sine: float
    force_cosine: float = 0.0
    coupling_damping: float = 0.0
    coupling_stiffness: float = 0.0
    base_acceleration: float = 0.0
    damping_rate: float = 0.0
    stiffness_rate: float = 0.0
    steady_resonator: complex | None = None
    path_rate: float = 0.0
    path_damping: float = 0.0

    def needed_force(
        self, load: float | Number, theta: Number, displacement: Number, velocity: Number
    ) -> Number:
        """Return the force in N that friction needs to hold the slider at constant velocity.

        ``displacement`` and ``velocity`` are those of the resonator.
        """
        sine: Number = np.sin(theta)
        cosine: Number = np.cos(theta)
        return (
            self.coupling_damping * velocity
            + self.coupling_stiffness * displacement
            + self.force_sine * sine
            + self.force_cosine * cosine
            - load
        )

    def friction_limit(self, angle: Number) -> Number:
        """Return the largest friction force in N at the angle psi + phase of the normal load."""
        sine: Number = np.sin(angle)
        return self.friction_mean + self.friction_amplitude * sine

    def slopes(
        self, mode: int | None, theta: float, angle: float, now: HeldInputs, width: float = 0.0
    ) -> Callable[[float, Array], list[float]]:
        """Return the time derivative of the state as a function of time (s) and state (4).

        The angles (rad) of drive and normal load and the inputs ``now`` are those at time 0. Within
        a contact mode the derivative is smooth; with mode None friction follows the sign of the
        velocity at every instant, or with a ``width`` in m/s its regularisation
        tanh(velocity / width), or in a state with a bristle (5) that.
        """
        rate, angle_rate = self.drive_frequency, now.frequency_ratio * self.drive_frequency
        half_acceleration = 0.5 * now.ratio_rate * self.drive_frequency
        slides = mode != STICK
        fixed_direction = 0 if mode is None or mode == LIFTED else mode

        def slopes(time: float, state: Array) -> list[float]:
            _, velocity, displacement, resonator_velocity, *bristle = state.tolist()
            sine = math.sin(theta + rate * time)
            resonator = self.base_acceleration * sine - self.damping_rate * resonator_velocity
            resonator -= self.stiffness_rate * displacement
            if not slides:
                return [0.0, 0.0, resonator_velocity, resonator]
            direction: float = fixed_direction
            force = (
                self.coupling_damping * resonator_velocity
                + self.coupling_stiffness * displacement
                + self.force_sine * sine
                - (now.load + now.load_rate * time)
            )
            if self.force_cosine:
                force += self.force_cosine * math.cos(theta + rate * time)
            turned = (angle_rate + half_acceleration * time) * time
            limit = self.friction_mean + self.friction_amplitude * math.sin(angle + turned)
            if mode is None:
                limit = max(0.0, limit)
                sign = (velocity > 0.0) - (velocity < 0.0)
                direction = math.tanh(velocity / width) if width else sign
            if bristle:
                stretch = self.path_rate * bristle[0]
                bristle = [velocity - abs(velocity) * stretch]
                direction = stretch + self.path_damping * bristle[0]
            acceleration = (force - direction * limit) / self.inertia
            return [velocity, acceleration, resonator_velocity, resonator - acceleration, *bristle]

        return slopes

    def contact_forces(
        self, mode: int, load: float | Array, theta: Array, angle: Array, states: Array
    ) -> tuple[Array, Array]:
        """Return normal and friction force in N along states (n, 4) or (n, 5) in one mode."""
        if mode == LIFTED:
            return np.zeros(len(theta)), np.zeros(len(theta))
        normal = np.maximum(0.0, self.normal_preload + self.normal_amplitude * np.sin(angle))
        if mode == STICK:
            return normal, self.needed_force(load, theta, states[:, 2], states[:, 3])
        grip: float | Array = mode
        if self.path_rate:
            velocity, stretch = states[:, 1], self.path_rate * states[:, 4]
            grip = stretch + self.path_damping * (velocity - np.abs(velocity) * stretch)
        return normal, grip * np.maximum(0.0, self.friction_limit(angle))

    def resonator_motion(self, theta: Array, states: Array) -> tuple[Array, Array]:
        """Return the displacement in m and velocity in m/s of the resonator along states (n, 4)."""
        if self.steady_resonator is None:
            return states[:, 2], states[:, 3]
        rotating: NDArray[np.complex128] = self.steady_resonator * np.exp(1j * theta)
        return rotating.imag, self.drive_frequency * rotating.real

    def fastest_rate(self, now: HeldInputs, span: float) -> float:
        """Return the largest of all rates in rad/s of the motion in slip, stick and flight.

        The inputs are ``now`` at the begin of a span in s.
        """
        first, last = now.frequency_ratio, now.frequency_ratio + now.ratio_rate * span
        damping = self.damping_rate + self.coupling_damping / self.inertia
        stiffness = self.stiffness_rate + self.coupling_stiffness / self.inertia
        root = 0.5 * damping + cmath.sqrt(0.25 * damping**2 - stiffness)
        return max(self.drive_frequency * max(1.0, abs(first), abs(last)), abs(root))

    def state_scales(self, load: float) -> Array:
        """Return characteristic sizes of the state, shape (4,), for absolute tolerances.

        They are what the forces, apart from the resonator's, would reach in 1 / drive_frequency.
        Never zero, even without any force.
        """
        force = (
            self.inertia * self.base_acceleration
            + abs(self.force_sine)
            + abs(self.force_cosine)
            + self.friction_mean
            + self.friction_amplitude
            + abs(load)
        )
        velocity = force / (self.inertia * self.drive_frequency)
        displacement = velocity / self.drive_frequency
        scales = np.array([displacement, velocity, displacement, velocity])
        return scales.clip(min=float(np.finfo(float).tiny))


def equations_of(device: Device) -> Equations:
    """Return the equations of motion of a device.

    Raises ValueError for fidelity 0, for LuGre friction without stiffness or coefficient, and in
    fidelity 1 for an undamped resonator at its slipping resonance, where (32) has no value.
    """
    if device.fidelity not in (1, 2):
        raise ValueError(f"fidelity = {device.fidelity!r}: only 1 and 2 are covered")
    coefficient = device.friction_faces * device.friction_coefficient
    contact = {
        "friction_mean": coefficient * device.normal_preload,
        "friction_amplitude": coefficient * device.normal_amplitude,
        "normal_preload": device.normal_preload,
        "normal_amplitude": device.normal_amplitude,
    }
    if device.friction_law == 1:
        for name in ("friction_coefficient", "bristle_stiffness"):
            if not (value := getattr(device, name)) > 0.0:
                raise ValueError(f"{name} = {value!r} must be greater than 0 for LuGre friction")
        contact["path_rate"] = device.bristle_stiffness / device.friction_coefficient
        contact["path_damping"] = device.bristle_damping / device.friction_coefficient
    frequency = device.drive_frequency
    if device.fidelity == 1:
        resonator, force = steady_vibration(device)
        return Equations(
            drive_frequency=frequency,
            inertia=device.total_mass,
            force_sine=force.real,
            force_cosine=force.imag,
            steady_resonator=resonator,
            **contact,
        )
    return Equations(
        drive_frequency=frequency,
        inertia=device.slider_mass,
        force_sine=device.tangential_force,
        coupling_damping=device.damping,
        coupling_stiffness=device.stiffness,
        base_acceleration=device.base_amplitude * frequency**2,
        damping_rate=2.0 * device.damping_ratio * device.resonator_frequency,
        stiffness_rate=device.resonator_frequency**2,
        **contact,
    )


def initial_state(device: Device) -> State:
    """Return the initial state; in fidelity 1 the resonator has none of its own.

    There it vibrates steadily from the start; the slider takes the rest of the momentum that the
    initial velocities give the pair. Raises ValueError as `equations_of` does.
    """
    velocity, displacement = device.initial_velocity, device.initial_resonator_displacement
    resonator_velocity = device.initial_resonator_velocity
    if device.fidelity == 1:
        amplitude, _ = steady_vibration(device)
        momentum = device.total_mass * velocity + device.resonator_mass * resonator_velocity
        momentum -= device.resonator_mass * device.drive_frequency * amplitude.real
        velocity, displacement, resonator_velocity = momentum / device.total_mass, 0.0, 0.0
    bristle = (device.initial_bristle_deflection,) if device.friction_law == 1 else ()
    return (device.initial_position, velocity, displacement, resonator_velocity, *bristle)
