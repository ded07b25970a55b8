"""Averaged motion of first order: the slow motion of the pair under mean friction.

With D the amplitude of the drive force on the pair, its momentum over the total mass is
P = X' + r_m Y' = V - D cos(theta) / (w (M + m)), and its centre is X + r_m Y. Both are continuous,
also where a parameter is tuned. V is the slow velocity: (M + m) V' = -mean friction - load. The
fast parts of all outputs are the steady vibration (32)-(33), added in closed form.

The bristle follows the motion periodically; it has no state here.
"""

from math import ceil, copysign, cos, hypot, inf, isfinite, pi, sin, tau

from .budget import Budget
from .contact import LIFTED, direction_of
from .device import Device, System, Vibration, steady_swing, vibration
from .dormand_prince import Rates, dormand_prince, linear_step, step_growth
from .moment import Moment
from .slow_friction import SlowFriction, full_friction, slow_friction

TOLERANCE = 2e-10
"""Error per step of the slow motion, relative to the fast velocity."""

FIRST_STEP = 0.1
"""Step tried first, as a share of the time in which friction changes the fast velocity."""

BEAT_SHARE = 0.125
"""Part of a beat that a step may have: its stages then see all phases of the normal load."""

PIECES = 256
"""Pieces of a beat, with constant friction in each, in motion without vibration."""

LINEAR = 4e-6
"""Change of the velocity up to which its rate may be linear, over the fast velocity."""

SETTLED = 0.01
"""Share of the tolerance for the error of the last step: no other one corrects it."""

FIRST_ORDER = 2.0
"""Error in friction shares and v_q: of the average, and of what the average leaves out, the
resonator's first swing and the first bend of bristles."""

STEPS = "steps of averaged motion"


class Averaged:
    """Motion averaged to first order (methods as of `motion.Resolved`)."""

    def __init__(self, system: System) -> None:
        """Raises Refusal where undamped resonance leaves no steady vibration."""
        self.system, self.fast = system, vibration(system.device)

    def start(self) -> Moment:
        """Initial velocities determine the momentum of the pair, not the vibration."""
        device = self.system.device
        now = Moment(
            device.initial_velocity,
            device.initial_resonator_displacement,
            device.initial_resonator_velocity,
            device.initial_position,
        )
        now.mode, now.complete = self.mode(now), True
        now.mean_velocity = self._slow_velocity(now)
        return now

    def advance(self, moment: Moment, duration: float) -> Moment:
        """The moment `duration` > 0 [s] later. Raises Refusal for too many steps."""
        system, fast, now = self.system, self.fast, moment.copied()
        w, share = system.drive_frequency, system.device.mass_fraction
        reach = fast.pair_velocity / w
        slow = self._slow_velocity(now)
        centre = now.position + share * now.displacement + reach * sin(now.theta)
        passed = _integrated if fast.velocity > 0.0 else _unshaken
        slow, moved = passed(self._friction(now), slow, duration)
        now.theta = (now.theta + w * duration) % tau
        now.psi = (now.psi + system.normal_frequency * duration) % tau
        now.displacement, now.rate = steady_swing(fast.resonator, now.theta, w)
        now.velocity = slow - fast.pair_velocity * cos(now.theta) - share * now.rate
        now.position = centre + moved - reach * sin(now.theta) - share * now.displacement
        now.mean_velocity, now.mode = slow, self.mode(now)
        return now

    def mode(self, now: Moment) -> int:
        """Contact mode, by the sign of the velocity with its fast part."""
        return LIFTED if self.system.is_lifted(now.psi) else direction_of(now.velocity)

    def friction_force(self, now: Moment, mode: int) -> float:
        """Mean friction force [N] over a drive period, positive against +X."""
        velocity, friction = now.mean_velocity, self._friction(now)
        if self.fast.velocity == 0.0 and velocity == 0.0:
            full = friction.at(0.0, inf)
            return max(-full, min(full, -self.system.load))
        return friction.at(0.0, velocity)

    def friction_power(self, now: Moment, mode: int) -> float:
        """Mean power of friction [W] over a drive period, of slow motion and vibration."""
        if self.fast.velocity == 0.0:
            return self.friction_force(now, mode) * now.mean_velocity
        return self._friction(now).power(now.mean_velocity)

    def resonator(self, now: Moment) -> tuple[float, float]:
        """Displacement [m] and velocity [m/s] of the steady vibration."""
        return steady_swing(self.fast.resonator, now.theta, self.system.drive_frequency)

    def slow_motion_error(self, now: Moment) -> float:
        """The estimate of the error of the slow velocity [m/s]."""
        return first_order_error(self.system.device, self.fast)

    def _friction(self, now: Moment) -> SlowFriction:
        return slow_friction(self.system, self.fast, now)

    def _slow_velocity(self, now: Moment) -> float:
        momentum = now.velocity + self.system.device.mass_fraction * now.rate
        return momentum + self.fast.pair_velocity * cos(now.theta)


def _integrated(friction: SlowFriction, velocity: float, duration: float) -> tuple[float, float]:
    """Slow velocity [m/s] and displacement [m] after `duration` [s], by Dormand and Prince's pair.

    A velocity that settles takes few steps, however long the duration is.
    """
    system, fast, max_steps = friction.system, friction.law.fast, friction.max_steps
    budget = Budget(duration)
    longest, max_change, tolerance = BEAT_SHARE * friction.beat, LINEAR * fast, TOLERANCE * fast
    strongest = system.friction_preload + system.friction_amplitude + abs(system.load)
    step = FIRST_STEP * fast * system.total_mass / strongest if strongest > 0.0 else duration

    def rates(t: float, v: float) -> Rates:
        return -(friction.at(t, v) + system.load) / system.total_mass, v

    # No step is longer than a share of a beat: too many of them are refused before the first.
    if duration > max_steps * longest:
        raise budget.refusal(max_steps * longest, max_steps, STEPS)
    t, moved, tried, first, gain = 0.0, 0.0, 0, rates(0.0, velocity), 0.0
    while t < duration and isfinite(velocity):
        if tried == max_steps:
            raise budget.refusal(t, max_steps, STEPS)
        left, end_of_smoothness, to = duration - t, friction.smooth_until(t, duration), None
        if friction.drift == 0.0 and tried > 0:
            to = linear_step(rates, t, velocity, left, first, gain, max_change)
        h = left
        if to is None or to.error > SETTLED * tolerance:
            h = min(step, longest, end_of_smoothness - t)
            to = dormand_prince(rates, t, velocity, h, first)
        tried += 1
        if not to.error > tolerance:
            velocity, moved, gain = to.velocity, moved + to.travel, to.gain
            t = t + h if t + h < end_of_smoothness else end_of_smoothness
            first = to.rates if end_of_smoothness == duration else rates(t, velocity)
        step = h * step_growth(to.error, tolerance)
    return velocity, moved


def _unshaken(friction: SlowFriction, velocity: float, duration: float) -> tuple[float, float]:
    """Velocity [m/s] and displacement [m] without vibration, under friction constant in pieces."""
    system, longest, max_pieces = friction.system, duration, friction.max_steps
    if friction.is_slow_load:
        longest = min(duration, friction.beat / PIECES)
    pieces = ceil(duration / longest)
    if pieces > max_pieces:
        raise Budget(duration).refusal(max_pieces * longest, max_pieces, STEPS)
    moved, piece = 0.0, duration / pieces
    for k in range(pieces):
        resisting = friction.at((k + 0.5) * piece, inf)
        velocity, passed = _block(velocity, resisting, system.load, system.total_mass, piece)
        moved += passed
    return velocity, moved


def _block(
    velocity: float, friction: float, load: float, mass: float, duration: float
) -> tuple[float, float]:
    """Velocity [m/s] and displacement [m] of a block without vibration, under constant forces."""
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


def friction_share(device: Device, fast: Vibration) -> float:
    """Share of friction in the inertia of the vibration, faces mu N0 / (Mt w v_q).

    It is the small number by which averages expand. What bristles damp while they bend counts, too:
    by the impulse of 2 mu s1/s0 per normal load after each reversal, but no more than s1 v_q.
    """
    friction = full_friction(device)
    if device.friction_law == 1:
        damped = device.bristle_damping * fast.velocity / device.friction_coefficient
        if device.bristle_stiffness > 0.0:
            bends = 2.0 / pi * device.bristle_damping / device.bristle_stiffness
            damped = min(damped, bends * device.drive_frequency)
        friction *= hypot(1.0, damped)
    return friction / (device.total_mass * device.drive_frequency * fast.velocity)


def decay_in_turn(device: Device, fast: Vibration) -> float:
    """Decay of the slowest transient of resonator and bristle in a turn of the drive."""
    decays = [inf]
    if device.resonator_mass > 0.0:
        slow = max(z.real for z in device.slip_oscillator.eigenvalues)
        decays.append(-slow * tau / device.drive_frequency)
    if device.friction_law == 1:
        path = 4.0 * fast.velocity / device.drive_frequency
        decays.append(device.bristle_stiffness * path / device.friction_coefficient)
    return min(decays)


def first_order_error(device: Device, fast: Vibration) -> float:
    """Error [m/s] of averages of first order."""
    share = friction_share(device, fast) if fast.velocity > 0.0 else 0.0
    if not share > 0.0:
        return 0.0
    decay = decay_in_turn(device, fast)
    swing = 1.0 + (1.0 / decay if decay > 0.0 else inf)
    return min(FIRST_ORDER * share * swing, 1.0) * fast.velocity
