"""Averaged motion of first order: the slow motion of the pair under mean friction.

The momentum of the pair over its mass is X' + r_m Y' = V - D cos(theta) / (w (M + m)), D being the
amplitude of the drive force on it, and its centre is X + r_m Y. Both are continuous, also where a
parameter is tuned. For the slow velocity V, (M + m) V' = -mean friction - load. The fast parts of
all outputs are the steady vibration (32)-(33), added in closed form. A bristle follows the motion
periodically; it has no state here.

The normal load counts with its phase near integer frequency ratios n, where that phase drifts by
(ratio - n) w (Appendix A for n = 1), and with its mean elsewhere. A load that lifts the contact has
harmonics, and counts with its phase near fractions too.
"""

from dataclasses import replace
from math import hypot, inf, pi, sin, tau

from .constants import MAX_SLOW_STEPS, PYTHON_SLOWDOWN
from .contact import LIFTED, VibratingLoad, direction_of, turns_to_repeat
from .device import System
from .mean_friction import MAX_WAVES, MeanFriction
from .moment import Moment
from .resolved import Resolved, initial_moment
from .slow_equation import Rates, SlowEquation
from .values import Budget

NEAR = 0.1
"""Largest distance of the frequency ratio from an integer at which the phase counts as slow; under
a lifting contact, of q times the ratio, times q."""

TOLERANCE = 2e-10
"""Error per step of the slow motion, relative to the fast velocity."""


class Averaged:
    """Motion averaged to first order (methods as of `Resolved`).

    The normal load has `waves` waves in a turn of the drive. Their phase drifts by `drift` [rad/s]
    and repeats after `beat` [s], which may be infinite. A communication step takes up to
    `max_steps` steps.
    """

    def __init__(self, system: System) -> None:
        device, ratio = system.device, system.inputs.frequency_ratio
        self.system, self.fast = system, system.steady
        self.law = MeanFriction(device, self.fast.velocity)
        turns = turns_to_repeat(ratio, system.normal_load.max_turns, NEAR)
        self.waves = round(turns * ratio) / turns if turns else ratio
        self.drift = (ratio - self.waves) * device.drive_frequency
        self.beat = tau / (turns * abs(self.drift)) if turns and self.drift else inf
        # Quadratures take longer the more waves the load has.
        waves = min(abs(self.waves), MAX_WAVES) if self.law.bends else 0.0
        self.max_steps = int(MAX_SLOW_STEPS / PYTHON_SLOWDOWN / (1.0 + waves))

    def start(self) -> Moment:
        """Initial velocities determine the momentum of the pair, not the vibration."""
        now = initial_moment(self.system.device)
        now.mode, now.complete = self.mode(now), True
        now.mean_velocity = self._slow_velocity(now)
        return now

    def advance(self, moment: Moment, duration: float) -> Moment:
        """The moment `duration` > 0 [s] later. Raises Refusal for too many steps."""
        fast, now = self.fast, moment.copied()
        w, share, reach = fast.frequency, fast.mass_fraction, fast.pair_velocity / fast.frequency
        slow = self._slow_velocity(now)
        centre = now.position + share * now.displacement + reach * sin(now.theta)
        if fast.velocity > 0.0:
            slow, moved = self._integrated(self._load_phase(now), slow, duration)
        else:
            motion, still = self._still(now)
            later = motion.advance(still, duration)
            slow, moved = later.velocity, later.position
        now.theta = (now.theta + w * duration) % tau
        now.psi = (now.psi + self.system.normal_frequency * duration) % tau
        now.displacement, now.rate = fast.swing(now.theta)
        now.velocity = slow - fast.ahead(now.theta, now.rate)
        now.position = centre + moved - reach * sin(now.theta) - share * now.displacement
        now.mean_velocity, now.mode = slow, self.mode(now)
        return now

    def mode(self, now: Moment) -> int:
        """Contact mode, by the sign of the velocity with its fast part."""
        return LIFTED if self.system.is_lifted(now.psi) else direction_of(now.velocity)

    def friction_force(self, now: Moment) -> float:
        """Mean friction force [N] over a drive period, positive against +X."""
        if self.fast.velocity > 0.0:
            return self._mean_friction(self._load_phase(now), self._slow_velocity(now))
        motion, still = self._still(now)
        return motion.friction_force(still)

    def friction_power(self, now: Moment) -> float:
        """Mean power of friction [W] over a drive period, of slow motion and vibration."""
        load = VibratingLoad(self.system.normal_load, self.waves, self._load_phase(now), MAX_WAVES)
        return self.law.power(load, self._slow_velocity(now))

    def slow_motion_error(self, now: Moment) -> float:
        """The estimate of the error of the slow velocity [m/s].

        Averages, and what they leave out, err by twice the velocity that friction changes in a
        radian of the drive, faces mu N0 / (Mt w). Bristles damp by the impulse of 2 mu s1/s0 per
        normal load at each of two reversals in a turn, but by no more than s1 v_q all the time.
        What averages leave out lasts as long as the slowest transient of resonator and bristle.
        """
        device, w, fast = self.system.device, self.fast.frequency, self.fast.velocity
        friction, mu, decay = device.full_friction, device.friction_coefficient, inf
        vibrates = fast > 0.0 or (device.normal_amplitude > 0.0 and self.system.normal_frequency)
        if not (vibrates and friction > 0.0):
            return 0.0
        if device.resonator_mass > 0.0:
            decay = -self.system.slip.eigenvalues[0].real * tau / w
        if device.friction_law == 1:
            stiffness, damping = device.bristle_stiffness, device.bristle_damping
            damped = damping * fast / mu
            if stiffness and fast:
                damped = min(damped, 2.0 / pi * damping / stiffness * w)
            friction *= hypot(1.0, damped)
            decay = min(decay, stiffness / mu * 4.0 * fast / w)
        changed = friction / (device.total_mass * w)
        swing = 1.0 + (1.0 / decay if decay > 0.0 else inf)
        return min(2.0 * changed * swing, max(fast, changed))

    def _still(self, now: Moment) -> tuple[Resolved, Moment]:
        """The pair without vibration: only the load is averaged, unless it is slow itself."""
        drift = 0.0 if self.waves else self.drift
        w = max(abs(drift), 1e-6)  # a drive that moves nothing, so slow that it ends no segment
        device = replace(self.system.device, fidelity=1, friction_law=0, drive_frequency=w)
        if self.waves:
            mean = device.normal_load.mean
            device = replace(device, normal_preload=mean, normal_amplitude=0.0)
        inputs = replace(self.system.inputs, frequency_ratio=drift / w)
        still = Moment(self._slow_velocity(now), 0.0, 0.0, 0.0, psi=now.psi)
        return Resolved(System(device, inputs)), still

    def _slow_velocity(self, now: Moment) -> float:
        return now.velocity + self.fast.ahead(now.theta, now.rate)

    def _load_phase(self, now: Moment) -> float:
        """Phase [rad] of the waves of the load in the angle of the fast velocity."""
        return self.system.phase + now.psi - self.waves * (now.theta - self.fast.lag)

    def _mean_friction(self, phase: float, velocity: float) -> float:
        """Mean friction [N] at a phase of the load [rad] and a slow velocity [m/s]."""
        load = VibratingLoad(self.system.normal_load, self.waves, phase, self.law.max_waves)
        return self.law.mean(load, self.law.turning(velocity))

    def _integrated(self, phase: float, velocity: float, duration: float) -> tuple[float, float]:
        """Slow velocity [m/s] and displacement [m] after `duration` [s]."""
        system, fast, drift = self.system, self.fast.velocity, self.drift
        strongest = system.friction_preload + system.friction_amplitude + abs(system.load)

        def rates(t: float, v: float) -> Rates:
            friction = self._mean_friction(phase + drift * t, v)
            return -(friction + system.load) / system.total_mass, v

        slow_time = fast * system.total_mass / strongest if strongest else inf
        equation = SlowEquation(rates, fast, TOLERANCE, slow_time, self.beat)
        budget = Budget(duration, 0.0, self.max_steps, "steps of averaged motion")
        t, moved = 0.0, 0.0
        for to in equation.steps(velocity, rates(0.0, velocity), duration):
            t, velocity, moved = t + to.length, to.velocity, moved + to.travel
            budget.spend(t)
        return velocity, moved
