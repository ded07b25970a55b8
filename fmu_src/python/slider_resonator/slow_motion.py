"""Averaged motion, fidelity 0: the slow motion of the pair under mean Coulomb friction.

With D the amplitude of the drive force on the pair, its momentum over the total mass is
P = X' + r_m Y' = V - D cos(theta) / (w (M + m)), and its centre is X + r_m Y. Both go on smoothly
whatever is tuned. V is the slow velocity, (M + m) V' = -mean friction - load. The fast parts of all
outputs are the steady vibration (32)-(33), added in closed form.

The normal load counts with its phase near integer frequency ratios n, where that phase drifts by
(ratio - n) w (Appendix A for n = 1), and with its mean elsewhere.
"""

from __future__ import annotations

from cmath import phase as argument
from collections.abc import Callable
from dataclasses import dataclass
from math import acos, copysign, cos, inf, pi, sin, tau

from .coulomb import Counts, Held, Moment, hold
from .device import Device, Inputs
from .dormand_prince import integrate
from .lugre import mode_of
from .motion import State
from .period import PeriodMeans
from .plant import equivalent_force, steady_resonator
from .refusal import Refusal
from .vibrating_load import VibratingLoad

NEAR = 0.1
"""Distance of the frequency ratio from an integer up to which the phase counts as slow."""

TOLERANCE = 1e-9
"""Error per step of the slow motion, relative to the fast velocity."""

FIRST_STEP = 0.1
"""Step tried first, as a share of the time in which friction changes the fast velocity."""


@dataclass(frozen=True, slots=True)
class SlowLaw:
    """The averaged device under held inputs (see `law.Law`)."""

    device: Device
    inputs: Inputs
    held: Held
    fast: _Fast

    def start(self, state: State, position: float) -> Moment:
        """See Law. The initial velocities fix the momentum of the pair, not the vibration."""
        mode = mode_of(self.held, state, 0.0)
        return Moment(state, position, 0.0, 0.0, mode, Counts(), inf, PeriodMeans())

    def advance(self, moment: Moment, duration: float) -> Moment:
        """See Law."""
        device, fast, load = self.device, self.fast, self.inputs.load
        w, q = self.held.plant.drive_frequency, self.held.plant.normal_frequency
        share, total, drive = device.mass_fraction, device.total_mass, fast.pair_velocity
        theta, psi, state = moment.theta, moment.psi, moment.state
        slow = state.velocity + share * state.rate + drive * cos(theta)
        centre = moment.position + share * state.displacement + drive / w * sin(theta)
        friction = self._mean_friction(theta, psi)
        if fast.velocity == 0.0:
            slow, moved = _block(slow, friction(0.0, inf), load, total, duration)
        else:
            full = friction(0.0, inf) + abs(load)
            slow, moved = integrate(
                lambda t, v: -(friction(t, v) + load) / total,
                slow,
                duration,
                FIRST_STEP * fast.velocity * total / full if full > 0.0 else duration,
                TOLERANCE * fast.velocity,
            )
        theta = (theta + w * duration) % tau
        psi = (psi + q * duration) % tau
        displacement, rate = fast.resonator(theta, w)
        state = State(slow - drive * cos(theta) - share * rate, displacement, rate)
        position = centre + moved - drive / w * sin(theta) - share * displacement
        means = PeriodMeans(complete=True, mean_velocity=slow)
        mode = mode_of(self.held, state, psi)
        return Moment(state, position, theta, psi, mode, moment.counts, inf, means)

    def mode(self, moment: Moment) -> int:
        """See Law: by the sign of the velocity with its fast part."""
        return mode_of(self.held, moment.state, moment.psi)

    def friction_force(self, moment: Moment, mode: int) -> float:
        """Mean friction force [N] over a drive period, positive against +X."""
        velocity = moment.means.present_mean_velocity(moment.state.velocity)
        if self.fast.velocity == 0.0 and velocity == 0.0:
            full = self._mean_friction(moment.theta, moment.psi)(0.0, inf)
            return max(-full, min(full, -self.inputs.load))
        return self._mean_friction(moment.theta, moment.psi)(0.0, velocity)

    def _mean_friction(self, theta: float, psi: float) -> Callable[[float, float], float]:
        """Mean friction [N] at time t [s] from now and slow velocity [m/s]."""
        device, ratio, fast = self.device, self.inputs.frequency_ratio, self.fast
        scale = device.friction_faces * device.friction_coefficient
        n = round(ratio)
        near = abs(ratio - n) <= NEAR
        drift = (ratio - n) * device.drive_frequency if near else 0.0
        phase = self.inputs.phase + psi - n * theta + n * fast.lag
        if near and n != 0 and device.normal_amplitude <= device.normal_preload:
            preload = scale * device.normal_preload
            swing = 2.0 * scale * device.normal_amplitude / (n * pi)

            def without_flight(t: float, velocity: float) -> float:
                turning = _turning(velocity, fast.velocity)
                steady = preload * (1.0 - 2.0 / pi * turning)
                return steady - swing * sin(n * turning) * sin(phase + drift * t)

            return without_flight

        def with_flight(t: float, velocity: float) -> float:
            turning = _turning(velocity, fast.velocity)
            load = VibratingLoad(device, float(n) if near else ratio, phase + drift * t)
            forward = load.integral(turning, tau - turning)
            return scale / tau * (forward - load.integral(-turning, turning))

        return with_flight


@dataclass(frozen=True, slots=True)
class _Fast:
    """The steady vibration: amplitudes [m/s], lag theta_1 [rad] and resonator [m] of (32)-(33)."""

    velocity: float
    pair_velocity: float
    lag: float
    amplitude: complex

    def resonator(self, theta: float, w: float) -> tuple[float, float]:
        """Steady displacement [m] and velocity [m/s] of the resonator."""
        real, imag = self.amplitude.real, self.amplitude.imag
        return (
            real * sin(theta) + imag * cos(theta),
            w * (real * cos(theta) - imag * sin(theta)),
        )


def _fast(device: Device) -> _Fast:
    """Raises Refusal where undamped resonance leaves no steady vibration."""
    w, total = device.drive_frequency, device.total_mass
    force = equivalent_force(device)
    pair = device.resonator_mass * device.base_amplitude * w * w + device.tangential_force
    return _Fast(
        abs(force) / (total * w), pair / (total * w), -argument(force), steady_resonator(device)
    )


def slow_law(device: Device, inputs: Inputs) -> SlowLaw:
    """The averaged law. Raises Refusal where averages do not apply."""
    if device.friction_law != 0:
        raise Refusal(
            f"fidelity = 0 refused with friction_law = {device.friction_law!r}: averaged motion "
            "allows 0 (Coulomb)"
        )
    return SlowLaw(device, inputs, hold(device, inputs), _fast(device))


def _turning(velocity: float, fast_velocity: float) -> float:
    """Angle tau at which sliding turns forward; 0 or pi once it no longer turns."""
    if abs(velocity) >= fast_velocity:
        return 0.0 if velocity > 0.0 else pi
    return acos(velocity / fast_velocity)


def _block(
    velocity: float, friction: float, load: float, mass: float, duration: float
) -> tuple[float, float]:
    """Velocity and displacement of a block without vibration, under constant forces."""
    moved = 0.0
    if velocity != 0.0:
        deceleration = (copysign(friction, velocity) + load) / mass
        stop = velocity / deceleration if deceleration * velocity > 0.0 else inf
        time = min(stop, duration)
        moved = velocity * time - 0.5 * deceleration * time * time
        if stop >= duration:
            return velocity - deceleration * duration, moved
        duration -= stop
    spare = abs(load) - friction
    if spare <= 0.0:
        return 0.0, moved
    acceleration = -copysign(spare, load) / mass
    return acceleration * duration, moved + 0.5 * acceleration * duration * duration
