"""Averaged motion, fidelity 0: the slow motion of the pair under mean friction.

With D the amplitude of the drive force on the pair, its momentum over the total mass is
P = X' + r_m Y' = V - D cos(theta) / (w (M + m)), and its centre is X + r_m Y. Both go on smoothly
whatever is tuned. V is the slow velocity, (M + m) V' = -mean friction - load. The fast parts of all
outputs are the steady vibration (32)-(33), added in closed form.

A LuGre bristle is taken as slaved to the motion, so it has no state here.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import copysign, cos, inf, sin, tau

from .bristle import bristle_of
from .coulomb import Counts, Held, Moment, hold
from .device import Device, Inputs
from .dormand_prince import integrate
from .fast_vibration import FastVibration, fast_vibration, steady_swing
from .lugre import mode_of
from .motion import State
from .period import PeriodMeans
from .slow_friction import slow_friction

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
    fast: FastVibration

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
        friction = slow_friction(device, self.inputs, fast, theta, psi)
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
        displacement, rate = steady_swing(fast.resonator, theta, w)
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
        friction = slow_friction(self.device, self.inputs, self.fast, moment.theta, moment.psi)
        if self.fast.velocity == 0.0 and velocity == 0.0:
            full = friction(0.0, inf)
            return max(-full, min(full, -self.inputs.load))
        return friction(0.0, velocity)


def slow_law(device: Device, inputs: Inputs) -> SlowLaw:
    """The averaged law. Raises Refusal where averages do not apply."""
    if device.friction_law == 1:
        bristle_of(device)
    return SlowLaw(device, inputs, hold(device, inputs), fast_vibration(device))


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
