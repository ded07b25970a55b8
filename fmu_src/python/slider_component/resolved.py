"""Resolved motion of a device: segment by segment, under any friction law.

A segment is motion without an event. It begins as the friction law says and ends at the first zero
of what it watches (a stop of the slider, or a release), at the latest where the contact lifts or
touches down. Another contact mode succeeds it. There is no step size.
"""

from math import tau

from .contact import LIFTED
from .coulomb import Coulomb
from .device import Device, System
from .first_zero import first_zero
from .lugre import LuGre
from .moment import Moment
from .values import Budget

COUNTED = 3.0
"""Drive periods before the end of a motion from which outputs count: means are those of the last
whole one. These periods end segments, too."""

PERIOD_END_TOLERANCE = 1e-7
"""Angle [rad] by which the end of a period may be ahead and still count as reached, so that steps
of whole periods complete their last period in spite of rounding."""

FRICTION_LAWS: tuple[Coulomb | LuGre, ...] = (Coulomb(), LuGre())
"""In the order of `friction_law`."""


def initial_moment(device: Device) -> Moment:
    """The initial values, at drive and normal phase 0."""
    velocity, rate = device.initial_velocity, device.initial_resonator_velocity
    return Moment(velocity, device.initial_resonator_displacement, rate, device.initial_position)


class Resolved:
    """Resolved motion with one or two degrees of freedom; other motions have the same methods."""

    def __init__(self, system: System) -> None:
        self.system, self.law = system, FRICTION_LAWS[system.device.friction_law]

    def start(self) -> Moment:
        """The first moment: the initial values.

        A resonator that is not resolved vibrates steadily at once; the velocity is chosen so that
        the momentum of the pair is that of the initial values.
        """
        device, system = self.system.device, self.system
        now = initial_moment(device)
        if not system.is_full:
            now.velocity += device.mass_fraction * (now.rate - system.steady.swing(0.0)[1])
            now.displacement = now.rate = 0.0
        if device.friction_law == 1:
            now.bristle = device.bristle_stiffness * device.initial_bristle_deflection
        now.mode = self.mode(now)
        return now

    def mode(self, now: Moment) -> int:
        """Contact mode under the held inputs."""
        lifted = self.system.is_lifted(now.psi)
        return LIFTED if lifted else self.law.mode(self.system, now)

    def friction_force(self, now: Moment) -> float:
        """Friction force [N] on the slider, positive against +X."""
        mode = self.mode(now)
        return 0.0 if mode == LIFTED else self.law.force(self.system, now, mode)

    def friction_power(self, now: Moment) -> float:
        """Mean power of friction [W] of the last whole period, or since the start, or there."""
        momentary = self.friction_force(now) * now.velocity
        return now.mean(now.friction_power, now.work, momentary)

    def slow_motion_error(self, now: Moment) -> float:
        """The estimate of the error of the slow velocity [m/s]; 0 for motion that never leaps."""
        return now.leap_error

    def advance(self, moment: Moment, duration: float) -> Moment:
        """The moment `duration` > 0 [s] later. Raises Refusal for too much work."""
        return self.resolve(moment, duration, Budget(duration, moment.time))

    def resolve(
        self, moment: Moment, duration: float, budget: Budget, modes: list[int] | None = None
    ) -> Moment:
        """As `advance`, within a budget; `modes` collects changes of contact mode."""
        w, now = self.system.drive_frequency, moment.copied()
        now.enter(self.mode(now))
        remaining, lost = duration, 0.0
        while remaining > 0.0:
            budget.spend(now.time)
            longest = min(remaining, self.system.arc)
            counts = (remaining - longest) * w <= COUNTED * tau
            if counts:
                longest = min(longest, (tau - now.theta) / w)
            t = self._follow(now, longest, counts)
            if not counts:
                now.theta %= tau
            elif now.theta + PERIOD_END_TOLERANCE >= tau:
                now.theta -= tau
                now.end_period()
            if modes is not None and modes[-1] != now.mode:
                modes.append(now.mode)
            # With the rounding errors of the differences (fast two-sum).
            rest = remaining - t
            lost += (remaining - rest) - t
            remaining = rest + lost if rest else 0.0
            lost -= remaining - rest
        return now

    def _follow(self, now: Moment, longest: float, counts: bool) -> float:
        """Advance `now` by one segment of up to `longest` [s], and return its time [s]."""
        system, chi = self.system, now.psi + self.system.phase
        q, lifted = system.normal_frequency, now.mode == LIFTED
        switching = system.normal_load.time_to_switch(chi, q, lifted)
        segment = self.law.begin(system, now)
        t, zero_of = min(longest, switching, segment.reach), None
        watches = segment.watches(t) if t > 0.0 else ()
        for index, watch in enumerate(watches):
            zero = first_zero(watch, t)
            if zero is not None:
                t, zero_of = zero, index
        now.velocity, now.displacement, now.rate, travelled = segment.at(t)
        if zero_of is not None and not segment.rests:
            now.velocity = 0.0
        if watches and now.mode != LIFTED and segment.direction not in (0, now.sliding):
            signal, noise, _ = watches[0]
            if signal(0.5 * t)[0] > noise:  # It moves beyond rounding.
                now.turn(segment.direction)
        if counts:
            now.travel += travelled
            now.work += segment.work(t, travelled)
            now.sticking += t if segment.rests else 0.0
            now.elapsed += t
        now.theta += system.drive_frequency * t
        now.psi = (now.psi + q * t) % tau
        now.position += travelled
        now.time += t
        switches = zero_of is None and t == switching
        self.law.enter_next_mode(system, now, travelled, zero_of, switches)
        return t
