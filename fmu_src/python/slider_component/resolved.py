"""Resolved motion of a device: segment by segment, under any friction law.

A segment is motion without an event. It begins as the friction law says and ends at the first zero
of what it watches (a stop of the slider, or a release), at the latest where the contact lifts or
touches down. Another contact mode succeeds it. There is no step size.
"""

from math import inf, tau

from .budget import Budget, Clock, too_much_work
from .contact import LIFTED
from .coulomb import Coulomb
from .device import LONGEST_ARC, System
from .first_zero import first_zero
from .lugre import LuGre
from .moment import Moment
from .sliding import Segment

MAX_TURN_SEGMENTS = 20_000
"""Largest number of segments accepted in a turn of the fastest oscillation: several times as many
as presliding on the hardest bristles takes."""

MOVES = 64.0
"""Travel beyond which a slider has surely moved, in rounding errors of its velocity times the time
in which the fastest oscillation advances by a radian: more than a segment can add up."""

COUNTED = 3.0
"""Drive periods before the end of a motion from which outputs count: means are those of the last
whole one, and the first that ends is counted in part."""

PERIOD_END_TOLERANCE = 1e-7
"""Angle [rad] by which the end of a period may be ahead and still count as reached, so that steps
of whole periods complete their last period in spite of rounding."""

FRICTION_LAWS: tuple[Coulomb | LuGre, ...] = (Coulomb(), LuGre())
"""In the order of `friction_law`."""


class Resolved:
    """Resolved motion with one or two degrees of freedom; other motions have the same methods."""

    def __init__(self, system: System) -> None:
        self.system, self.law = system, FRICTION_LAWS[system.device.friction_law]

    def start(self) -> Moment:
        """The first moment, at drive and normal phase 0: the initial values.

        A resonator that is not resolved vibrates steadily at once; the velocity is chosen so that
        the momentum of the pair is that of the initial values.
        """
        device, system = self.system.device, self.system
        velocity, rate = device.initial_velocity, device.initial_resonator_velocity
        if not system.is_full:
            velocity += device.mass_fraction * (rate - system.steady.swing(0.0)[1])
        now = Moment(velocity, device.initial_resonator_displacement, rate, device.initial_position)
        if device.friction_law == 1:
            now.bristle = device.bristle_stiffness * device.initial_bristle_deflection
        now.mode = self.mode(now)
        return now

    def mode(self, now: Moment) -> int:
        """Contact mode under the held inputs."""
        return self.law.mode(self.system, now)

    def friction_force(self, now: Moment) -> float:
        """Friction force [N] on the slider, positive against +X."""
        return self.law.force(self.system, now, self.mode(now))

    def friction_power(self, now: Moment) -> float:
        """Mean power of friction [W] of the last whole period, or since the start, or there."""
        momentary = self.friction_force(now) * now.velocity
        return now.mean(now.friction_power, now.work, momentary)

    def resonator(self, now: Moment) -> tuple[float, float]:
        """Displacement [m] and velocity [m/s] of the resonator: its own or the steady ones."""
        if self.system.is_full:
            return now.displacement, now.rate
        return self.system.steady.swing(now.theta)

    def slow_motion_error(self, now: Moment) -> float:
        """The estimate of the error of the slow velocity [m/s]; 0 for motion that never leaps."""
        return now.leap_error

    def advance(self, moment: Moment, duration: float) -> Moment:
        """The moment after a communication step of `duration` > 0 [s].

        Raises Refusal for more work than a step may take.
        """
        return self.resolve(moment, duration, Budget(duration))

    def resolve(
        self, moment: Moment, duration: float, budget: Budget, modes: list[int] | None = None
    ) -> Moment:
        """The moment `duration` > 0 [s] later; `modes` collects changes of contact mode.

        Raises Refusal for more segments than the budget has, or for too many in a turn.
        """
        system, arc = self.system, self.system.arc
        if duration > budget.left * arc:
            raise budget.refusal(budget.left * arc)
        clock, remaining, in_turn, turn_began = Clock(duration), duration, 0, 0.0
        turn, period = tau / LONGEST_ARC * arc, tau / system.drive_frequency
        now = moment.copied()
        now.enter(self.mode(now))
        while remaining > 0.0:
            if clock.elapsed - turn_began > turn:
                in_turn, turn_began = 0, clock.elapsed
            if in_turn == MAX_TURN_SEGMENTS:
                what = "segments in a turn of the fastest oscillation"
                raise too_much_work(budget.step_size, clock.elapsed, MAX_TURN_SEGMENTS, what)
            if budget.left == 0:
                raise budget.refusal(clock.elapsed)
            in_turn += 1
            budget.left -= 1
            longest = min(remaining, arc)
            counts = remaining - longest <= COUNTED * period
            t = self._follow(now, min(longest, period) if counts else longest, counts)
            if modes is not None and modes[-1] != now.mode:
                modes.append(now.mode)
            remaining = clock.advance(t) if t != remaining else 0.0
        return now

    def _follow(self, now: Moment, longest: float, counts: bool) -> float:
        """Advance `now` by one segment of up to `longest` [s], and return its time [s]."""
        system, w, switching = self.system, self.system.drive_frequency, inf
        if system.switches:
            chi, lifted = now.psi + system.phase, now.mode == LIFTED
            switching = system.window.time_to_switch(chi, system.normal_frequency, lifted)
        segment = self.law.begin(system, now)
        direction = segment.direction
        t, zero_of = min(longest, switching, segment.reach), None
        watches = segment.watches(t) if t > 0.0 else ()
        for index, watch in enumerate(watches):
            zero = first_zero(watch, t)
            if zero is not None:
                t, zero_of = zero, index
        now.velocity, now.displacement, now.rate, travelled = segment.at(t)
        if zero_of is not None and not segment.rests:
            now.velocity = 0.0
        if now.mode != LIFTED and direction not in (0, now.sliding) and watches:
            signal, noise, fastest = watches[0]
            # Most travel is far more than rounding; where it is not, the velocity in the middle
            # tells.
            if direction * travelled * fastest > MOVES * noise or signal(0.5 * t)[0] > noise:
                now.turn(direction)
        if counts:
            _count(now, segment, t, travelled, w)
        else:
            now.theta = (now.theta + w * t) % tau
        now.psi = (now.psi + system.normal_frequency * t) % tau
        now.position += travelled
        now.event_age += t
        self.law.enter_next_mode(
            system, now, travelled, zero_of, zero_of is None and t == switching
        )
        return t


def _count(now: Moment, segment: Segment, t: float, travelled: float, frequency: float) -> None:
    """Advance drive phase and sums over the first `t` [s] of a segment, at most a period.

    Where a drive period ends in it, the sums give the means. The drive has `frequency` [rad/s].
    """
    end, rests = now.theta + frequency * t, segment.rests
    work = segment.work(t, travelled)
    if end + PERIOD_END_TOLERANCE >= tau:
        last = (tau - now.theta) / frequency
        passed, stuck = segment.at(last)[3], last if rests else 0.0
        worked, length = segment.work(last, passed), now.elapsed + last
        now.mean_velocity = (now.travel + passed) / length
        now.friction_power = (now.work + worked) / length
        now.stick_fraction = min(max((now.sticking + stuck) / length, 0.0), 1.0)
        now.complete = True
        now.travel, now.work, now.sticking, now.elapsed = -passed, -worked, -stuck, -last
        end -= tau
    now.travel += travelled
    now.work += work
    now.sticking += t if rests else 0.0
    now.elapsed += t
    now.theta = end
