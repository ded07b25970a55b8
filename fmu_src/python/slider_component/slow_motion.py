"""Averaged motion, fidelity 0: the slow motion of the pair under mean friction.

With D the amplitude of the drive force on the pair, its momentum over the total mass is
P = X' + r_m Y' = V - D cos(theta) / (w (M + m)), and its centre is X + r_m Y. Both are continuous,
also where a parameter is tuned. V is the slow velocity: (M + m) V' = -mean friction - load. The
fast parts of all outputs are the steady vibration (32)-(33), added in closed form.

The bristle follows the motion periodically; it has no state here.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil, copysign, cos, inf, sin, tau

from .averaged_lugre import MAX_WAVES
from .budget import Budget
from .constants import MAX_QUADRATURE_STEPS, MAX_SLOW_STEPS, PYTHON_SLOWDOWN
from .dormand_prince import Reached
from .fast_vibration import FastVibration, fast_vibration, steady_swing
from .friction_law import FrictionLaw
from .held import Held
from .moment import Counts, Moment
from .motion import State
from .orbit_state import Stage
from .period import PeriodMeans
from .slow_friction import SlowFriction, slow_friction
from .slow_motion_error import first_order_error
from .slow_pass import STEPS, SlowPass, first_step

TOLERANCE = 2e-10
"""Error per step of the slow motion, relative to the fast velocity."""

WAVES = 10.0
"""Number of waves of the normal load over a turn that doubles the cost of a quadrature."""

MIN_STEPS = 16
"""Lower limit of the number of steps that is accepted."""

PIECES = 256
"""Pieces of a beat, with constant friction in each, in motion without vibration."""


@dataclass(frozen=True, slots=True)
class SlowLaw:
    """The averaged device under held inputs (see `law.Law`)."""

    held: Held
    friction: FrictionLaw
    fast: FastVibration

    def start(self, state: State, position: float) -> Moment:
        """See Law. Initial velocities determine the momentum of the pair, not the vibration."""
        mode = self.held.mode_by_velocity(state.velocity, 0.0)
        means = PeriodMeans(complete=True, mean_velocity=self._slow_velocity(state, 0.0))
        return Moment(state, position, 0.0, 0.0, mode, Counts(), inf, means)

    def advance(self, moment: Moment, duration: float) -> Moment:
        """See Law."""
        held, fast = self.held, self.fast
        w, q = held.plant.drive_frequency, held.plant.normal_frequency
        share, drive = held.device.mass_fraction, fast.pair_velocity
        theta, psi, state = moment.theta, moment.psi, moment.state
        slow = self._slow_velocity(state, theta)
        centre = moment.position + share * state.displacement + drive / w * sin(theta)
        slow, moved = self._passed(slow, theta, psi, duration)
        theta = (theta + w * duration) % tau
        psi = (psi + q * duration) % tau
        displacement, rate = steady_swing(fast.resonator, theta, w)
        state = State(slow - drive * cos(theta) - share * rate, displacement, rate)
        position = centre + moved - drive / w * sin(theta) - share * displacement
        means = PeriodMeans(complete=True, mean_velocity=slow)
        mode = held.mode_by_velocity(state.velocity, psi)
        return Moment(state, position, theta, psi, mode, moment.counts, inf, means)

    def _slow_velocity(self, state: State, theta: float) -> float:
        momentum = state.velocity + self.held.device.mass_fraction * state.rate
        return momentum + self.fast.pair_velocity * cos(theta)

    def _passed(
        self, velocity: float, theta: float, psi: float, duration: float
    ) -> tuple[float, float]:
        """Slow velocity [m/s] and displacement [m] after `duration` [s].

        A velocity that settles takes few steps, however long the duration is.
        """
        fast, load, total = self.fast.velocity, self.held.inputs.load, self.held.plant.total_mass
        friction = self._friction(theta, psi)
        if fast == 0.0:
            return _unshaken(friction, velocity, load, total, duration)

        def acceleration(t: float, v: float) -> float:
            return -(friction.at(t, v) + load) / total

        step = first_step(fast, total, self._strongest_friction() + abs(load), duration)
        slow_pass = SlowPass(
            acceleration,
            fast,
            TOLERANCE * fast,
            step,
            may_settle=friction.drift == 0.0,
            max_steps=_max_steps(friction.is_expensive, self.held.inputs.frequency_ratio),
            beat=friction.beat,
            to_kink=friction.to_kink,
        )
        reached = slow_pass.reach(duration, Reached(0.0, velocity, 0.0, step), Budget(duration))
        return reached.velocity, reached.moved

    def _strongest_friction(self) -> float:
        """Largest Coulomb friction [N] over all phases of the normal load."""
        device = self.held.device
        normal = device.normal_preload + device.normal_amplitude
        return device.friction_faces * device.friction_coefficient * normal

    def mode(self, moment: Moment) -> int:
        """See Law: by the sign of the velocity with its fast part."""
        return self.held.mode_by_velocity(moment.state.velocity, moment.psi)

    def friction_force(self, moment: Moment, mode: int) -> float:
        """Mean friction force [N] over a drive period, positive against +X."""
        velocity = moment.means.present_mean_velocity(moment.state.velocity)
        friction = self._friction(moment.theta, moment.psi)
        if self.fast.velocity == 0.0 and velocity == 0.0:
            full = friction.at(0.0, inf)
            return max(-full, min(full, -self.held.inputs.load))
        return friction.at(0.0, velocity)

    def swing(self, moment: Moment) -> tuple[float, float]:
        """See Law: the steady vibration, or the resolved one of motion along orbits."""
        if moment.orbit.stage != Stage.AVERAGED:
            return moment.state.displacement, moment.state.rate
        return steady_swing(self.fast.resonator, moment.theta, self.held.plant.drive_frequency)

    def settled(self, moment: Moment) -> Moment:
        """See Law."""
        return moment

    def slow_motion_error(self, moment: Moment) -> float:
        """See Law."""
        return first_order_error(self.held.device, self.fast)

    def _friction(self, theta: float, psi: float) -> SlowFriction:
        return slow_friction(self.held, self.friction.averaged, self.fast, theta, psi)


def slow_law(held: Held, friction: FrictionLaw) -> SlowLaw:
    """The averaged law. Raises Refusal where averages do not apply."""
    return SlowLaw(held, friction, fast_vibration(held.device))


def _max_steps(is_expensive: bool, ratio: float) -> int:
    """Steps of averaged motion that a whole budget buys."""
    if not is_expensive:
        return MAX_SLOW_STEPS // PYTHON_SLOWDOWN
    waves = min(abs(ratio), MAX_WAVES)
    return max(MIN_STEPS, int(MAX_QUADRATURE_STEPS // PYTHON_SLOWDOWN / (1.0 + waves / WAVES)))


def _unshaken(
    friction: SlowFriction, velocity: float, load: float, mass: float, duration: float
) -> tuple[float, float]:
    """Velocity [m/s] and displacement [m] without vibration.

    Friction is constant in each piece of time.
    """
    longest = duration if friction.to_kink is None else min(duration, friction.beat / PIECES)
    pieces = ceil(duration / longest)
    max_pieces = _max_steps(is_expensive=False, ratio=0.0)
    if pieces > max_pieces:
        raise Budget(duration).refusal(max_pieces * longest, max_pieces, STEPS)
    moved, piece = 0.0, duration / pieces
    for k in range(pieces):
        resisting = friction.at((k + 0.5) * piece, inf)
        velocity, passed = _block(velocity, resisting, load, mass, piece)
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
