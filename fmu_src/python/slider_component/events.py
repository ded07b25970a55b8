"""Resolved motion: the loop over events, segment by segment, under any friction law.

A segment is motion without an event. It begins as the friction law says and ends at the first zero
of what it watches (a stop of the slider, or a release), at the latest where the contact lifts or
touches down. Another contact mode succeeds it. There is no step size.
"""

from math import floor, inf, tau

from .budget import Budget, Clock
from .constants import MAX_STEP_SEGMENTS, PYTHON_SLOWDOWN
from .contact import LIFTED
from .coulomb import Coulomb
from .device import LONGEST_ARC, System
from .first_zero import first_zero
from .lugre import LuGre
from .moment import Moment
from .sliding import Segment

MAX_SEGMENTS = 20_000
"""Largest number of segments accepted in a turn of the fastest oscillation: several times as many
as presliding on the hardest bristles takes."""

MOVES = 64.0
"""Travel beyond which a slider has surely moved, in rounding errors of its velocity times the time
in which the fastest oscillation advances by a radian: more than a segment can add up."""

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

    Raises Refusal for a motion of more segments than the budget has, or of too many in a turn.
    """
    law, arc = law_of(system), system.arc
    max_segments = MAX_STEP_SEGMENTS // PYTHON_SLOWDOWN
    allowed = budget.left(max_segments)
    if duration > allowed * arc:
        raise budget.refusal(allowed * arc, max_segments, "segments of motion")
    clock, remaining = Clock(duration), duration
    segments, all_segments, turn_began = 0, 0, 0.0
    turn, counted = tau / LONGEST_ARC * arc, COUNTED * tau / system.drive_frequency
    now = moment.copied()
    now.enter(law.mode(system, now))
    while remaining > 0.0:
        if clock.elapsed - turn_began > turn:
            segments, turn_began = 0, clock.elapsed
        segments, all_segments = segments + 1, all_segments + 1
        if segments > MAX_SEGMENTS:
            what = "segments in a turn of the fastest oscillation"
            raise budget.refusal(clock.elapsed, MAX_SEGMENTS, what)
        if all_segments > allowed:
            raise budget.refusal(clock.elapsed, max_segments, "segments of motion")
        longest = min(remaining, arc)
        t = _follow(law, system, now, longest, remaining - longest <= counted)
        if modes is not None and modes[-1] != now.mode:
            modes.append(now.mode)
        remaining = clock.advance(t) if t != remaining else 0.0
    budget.spend(all_segments, max_segments)
    return now


def _follow(
    law: FrictionLaw, system: System, now: Moment, longest: float, counts_work: bool
) -> float:
    """Advance `now` by one segment of up to `longest` [s], and return its time [s]."""
    switching = inf
    if system.switches:
        chi, lifted = now.psi + system.phase, now.mode == LIFTED
        switching = system.window.time_to_switch(chi, system.normal_frequency, lifted)
    segment = law.begin(system, now)
    rests, direction = segment.rests, segment.direction
    t, zero_of = min(longest, switching, segment.reach), None
    watches = segment.watches(t) if t > 0.0 else ()
    for index, watch in enumerate(watches):
        zero = first_zero(watch, t)
        if zero is not None:
            t, zero_of = zero, index
    now.velocity, now.displacement, now.rate, travelled = segment.at(t)
    if zero_of is not None and not rests:
        now.velocity = 0.0
    if direction not in (0, now.sliding) and watches:
        signal, noise, fastest, *_ = watches[0]
        # Most travel is far more than rounding; where it is not, the velocity in the middle tells.
        if direction * travelled * fastest > MOVES * noise or signal(0.5 * t)[0] > noise:
            now.turn(direction)
    _count(now, segment, t, travelled, system.drive_frequency, counts_work)
    now.psi = (now.psi + system.normal_frequency * t) % tau
    law.succeed(system, now, travelled, zero_of, switches=zero_of is None and t == switching)
    return t


def _count(
    now: Moment, segment: Segment, t: float, travelled: float, frequency: float, counts_work: bool
) -> None:
    """Advance position, drive phase and means over the first `t` [s] of a segment.

    Where drive periods end in it, the last of them gives the means. The drive has `frequency`
    [rad/s].
    """
    end, rests = now.theta + frequency * t, segment.rests
    work = segment.work(t, travelled) if counts_work else 0.0
    now.position += travelled
    now.event_age += t
    if end + MARK_TOLERANCE >= tau:
        ended = floor((end + MARK_TOLERANCE) / tau)
        last = (tau * ended - now.theta) / frequency
        if ended > 1:
            # Sums as of the begin of the last period.
            begin = last - tau / frequency
            before = segment.at(begin)[3]
            now.travel, now.work = -before, -segment.work(begin, before) if counts_work else 0.0
            now.elapsed, now.sticking = -begin, -begin if rests else 0.0
        passed = segment.at(last)[3]
        worked = segment.work(last, passed) if counts_work else 0.0
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
