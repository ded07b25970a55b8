"""Resolved motion: the loop over events, leg by leg, under any friction law.

A leg is motion without an event: it begins as the friction law says, ends at the first zero of what
it watches (a stop of the slider, or a release), at the latest where the contact lifts or touches
down, and is succeeded by another contact mode. There is no step size.
"""

from __future__ import annotations

from math import floor, inf, tau

from .budget import Budget, Clock
from .constants import MAX_STEP_LEGS, PYTHON_SLOWDOWN
from .contact import LIFTED
from .coulomb import Coulomb
from .device import LONGEST_ARC, System
from .first_zero import first_zero
from .lugre import LuGre
from .moment import Moment
from .sliding import Motion

MAX_LEGS = 20_000
"""Largest number of legs accepted in a turn of the fastest oscillation: several times as many as
presliding on the hardest bristles takes."""

MOVES = 64.0
"""Travel beyond which a slider has surely moved, in rounding errors of its velocity times the time
in which the fastest oscillation advances by a radian: more than a leg can add up."""

COUNTED = 3.0
"""Drive periods before the end of a motion from which the work of friction counts: its mean is that
of the last whole one, and the first that ends is counted in part."""

MARK_TOLERANCE = 1e-7
"""Angle [rad] by which the end of a period may be ahead and still count as reached, so that steps
of whole periods complete their last period in spite of rounding."""

FrictionLaw = Coulomb | LuGre

FRICTION_LAWS: tuple[FrictionLaw, ...] = (Coulomb(), LuGre())
"""In the order of `friction_law`."""


def law_of(system: System) -> FrictionLaw:
    """The friction law of a system."""
    return FRICTION_LAWS[system.device.friction_law]


def advance(
    system: System,
    moment: Moment,
    duration: float,
    budget: Budget,
    modes: list[int] | None = None,
) -> Moment:
    """The moment `duration` > 0 [s] later, inputs held; `modes` collects changes of contact mode.

    Raises Refusal for a motion of more legs than the budget has, or of too many in a turn.
    """
    law, arc = law_of(system), system.arc
    max_legs = MAX_STEP_LEGS // PYTHON_SLOWDOWN
    allowed = budget.left(max_legs)
    if duration > allowed * arc:
        raise budget.refusal(allowed * arc, max_legs, "legs of motion")
    clock, remaining = Clock(duration), duration
    legs, all_legs, turn_began = 0, 0, 0.0
    turn, counted = tau / LONGEST_ARC * arc, COUNTED * tau / system.drive_frequency
    now = moment.copied()
    now.enter(law.mode(system, now))
    while remaining > 0.0:
        if clock.elapsed - turn_began > turn:
            legs, turn_began = 0, clock.elapsed
        legs, all_legs = legs + 1, all_legs + 1
        if legs > MAX_LEGS:
            what = "legs in a turn of the fastest oscillation"
            raise budget.refusal(clock.elapsed, MAX_LEGS, what)
        if all_legs > allowed:
            raise budget.refusal(clock.elapsed, max_legs, "legs of motion")
        longest = min(remaining, arc)
        t = _leg(law, system, now, longest, remaining - longest <= counted)
        if modes is not None and modes[-1] != now.mode:
            modes.append(now.mode)
        remaining = clock.advance(t) if t != remaining else 0.0
    budget.spend(all_legs, max_legs)
    return now


def _leg(law: FrictionLaw, system: System, now: Moment, longest: float, counts_work: bool) -> float:
    """Advance `now` by one leg of up to `longest` [s], and return its time [s]."""
    switching = inf
    if system.switches:
        chi, lifted = now.psi + system.phase, now.mode == LIFTED
        switching = system.window.time_to_switch(chi, system.normal_frequency, lifted)
    motion = law.begin(system, now)
    rests, direction = motion.rests, motion.direction
    t, zero_of = min(longest, switching, motion.reach), None
    watches = motion.watches(t) if t > 0.0 else ()
    for index, watch in enumerate(watches):
        zero = first_zero(watch, t)
        if zero is not None:
            t, zero_of = zero, index
    now.velocity, now.displacement, now.rate, travelled = motion.at(t)
    if zero_of is not None and not rests:
        now.velocity = 0.0
    if direction not in (0, now.sliding) and watches:
        signal, noise, fastest, *_ = watches[0]
        # Most travel is far more than rounding; where it is not, the velocity in the middle tells.
        if direction * travelled * fastest > MOVES * noise or signal(0.5 * t)[0] > noise:
            now.turn(direction)
    _count(now, motion, t, travelled, system.drive_frequency, counts_work)
    now.psi = (now.psi + system.normal_frequency * t) % tau
    law.succeed(system, now, travelled, zero_of, switches=zero_of is None and t == switching)
    return t


def _count(
    now: Moment, motion: Motion, t: float, travelled: float, frequency: float, counts_work: bool
) -> None:
    """Advance position, drive phase and means by a leg of `t` [s], `frequency` [rad/s] the drive's.

    Where drive periods end in the leg, the last of them gives the means.
    """
    end, rests = now.theta + frequency * t, motion.rests
    work = motion.work(t, travelled) if counts_work else 0.0
    now.position += travelled
    now.event_age += t
    if end + MARK_TOLERANCE >= tau:
        ended = floor((end + MARK_TOLERANCE) / tau)
        last = (tau * ended - now.theta) / frequency
        if ended > 1:
            # Sums as of the begin of the last period.
            begin = last - tau / frequency
            before = motion.at(begin)[3]
            now.travel, now.work = -before, -motion.work(begin, before) if counts_work else 0.0
            now.elapsed, now.sticking = -begin, -begin if rests else 0.0
        passed = motion.at(last)[3]
        worked = motion.work(last, passed) if counts_work else 0.0
        stuck, length = last if rests else 0.0, now.elapsed + last
        now.mean_velocity = (now.travel + passed) / length
        now.friction_power = (now.work + worked) / length
        now.stick_fraction = min(max((now.sticking + stuck) / length, 0.0), 1.0)
        now.complete = True
        now.travel, now.work, now.sticking, now.elapsed = -passed, -worked, -stuck, -last
        end -= tau * ended
    now.travel += travelled
    now.work += work
    now.sticking += t if rests else 0.0
    now.elapsed += t
    now.theta = end
