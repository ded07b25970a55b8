"""Motion that leaps over periods: fidelity 0, averages of second order.

A step of the host resolves the motion to the next section of the period map, leaps over a whole
number of periods, and resolves the last ones: outputs, events and state are those of resolved
motion. Where a leap gains nothing or does not hold, motion stays resolved.

In a leap the slow velocity V obeys dV/dn = g(V, n), n being the number of periods. g is that on the
slow manifold, where the fast states follow V smoothly: their differences of high order over the
periods vanish (Gear, Kaper, Kevrekidis, Zagaris 2005).
"""

from collections.abc import Iterable
from contextlib import suppress
from itertools import pairwise
from math import floor, inf, pi, sqrt, tau
from typing import NamedTuple

from .budget import Budget, Clock
from .device import System
from .dormand_prince import Rates, Step, dormand_prince, linear_step, step_growth
from .moment import Moment
from .period_map import Fast, NoMapError, Numbers, PeriodMap
from .resolved import Resolved
from .values import Refusal

ORDER = 3
"""Order of the differences: a sequence maps so many periods."""

MAX_SEQUENCES = 6
"""Most sequences in which Newton's method finds the manifold."""

MAX_CONTRACTION = 0.5
"""Largest ratio of its successive corrections that counts as convergence."""

FAST_SHARE = 0.3
"""Share of the tolerance for errors of the fast states."""

ERROR_SHARE = 0.3
"""Error of the solver's result, of order 5, over its estimate, of order 4: 0.2 and a margin."""

HERMITE_SHARE = 0.5
"""What the error of Hermite's rule counts: it mostly is one to two times that estimate."""

FIRST_STEP = 3.0
"""First step of the solver over the time in which rates change, where V changes by a tolerance."""

SHORTEST_STEP = 12.0 * ORDER
"""Fewest periods of a step: its six evaluations map half as many."""

MAX_STEP_DRIFT = pi / 4.0
"""Largest drift of the load's phase [rad] in a step: an eighth of a beat, so that the stages of the
step see all its phases."""

LINEAR = 0.3
"""Change of V up to which its rate may be linear, over v_q and the root of the tolerance."""

TO_GRAZING = 0.5
"""Part of the way to a grazing velocity that a step may pass: there rates are singular."""

NO_DRIFT = 1e-9
"""Drift of the load's phase [rad] over a leap up to which its rates depend on V alone."""

MAX_TURNS = 4
"""Largest number of turns after which the normal load may repeat."""

SHORTEST_LEAP = 64.0
"""Fewest periods that may be left for a leap."""

PAUSE = 8.0
"""Periods that are resolved after an attempt, by period mapped in vain: attempts cost an eighth of
resolved motion at most."""

MIN_PAUSE = 32.0
"""Fewest periods that are resolved between two leaps: past a kink, or while a transient decays."""


class Point(NamedTuple):
    """A point of the slow manifold, `n` periods after the start of a leap.

    The slow `velocity` [m/s] and the fast states; their rates by period (`acceleration` that of V)
    and that of the position, `travel`; the `gain` d(acceleration)/dV; the estimated `error` of the
    acceleration; the contact `modes` of the sequence and the moments at the `sections`.
    """

    n: float
    velocity: float
    fast: Fast
    acceleration: float
    travel: float
    fast_rate: Fast
    gain: float
    error: float
    modes: list[int]
    sections: list[Moment]


def _differences(rows: list[Numbers]) -> list[Numbers]:
    """Differences of order 0, 1, ... at the begin of a sequence."""
    found = []
    while rows:
        found.append(rows[0])
        rows = [[b - a for a, b in zip(*pair, strict=True)] for pair in pairwise(rows)]
    return found


def _rate(differences: Iterable[float]) -> float:
    """Rate of a smooth sequence: the logarithm of the shift operator, a series of differences."""
    return sum((d if j % 2 else -d) / j for j, d in enumerate(differences) if j > 0)


def _next_term(before: float, last: float) -> float:
    """Size of the next term after a term `last`, if terms go on to shrink as they did."""
    before, last = abs(before), abs(last)
    return last * (last / before) if before > last else last


def _hermite_error(begin: Point, end: Point, h: float) -> float:
    """What the change of V over `h` periods differs by from the integral of a cubic [m/s].

    The cubic has the accelerations at both ends, and their rates. The error of the solver may be
    small by accident, but not both.
    """
    bend = begin.gain * begin.acceleration - end.gain * end.acceleration
    mean = 0.5 * (begin.acceleration + end.acceleration) + h / 12.0 * bend
    return abs(end.velocity - begin.velocity - h * mean)


class SlowMotion:
    """The slow motion from the moment `begin` at the section on.

    `varies`: its rates depend on n, too. `here` is the point where the present step of the solver
    begins, `last` the one found last; `maps` counts mapped periods.
    """

    def __init__(self, period_map: PeriodMap, begin: Moment, budget: Budget, longest: float):
        """Raises NoMapError for a moment off the manifold."""
        self.map, self.begin, self.budget = period_map, begin, budget
        self.allowed = period_map.tolerance * period_map.speed
        self.varies, self.maps = abs(period_map.drift) * longest > NO_DRIFT, 0
        velocity, _, *fast = period_map.numbers(begin)
        self.here = self.last = self.point(0.0, velocity, fast, max_sequences=1)

    def point(
        self, n: float, velocity: float, fast: Fast, max_sequences: int = MAX_SEQUENCES
    ) -> Point:
        """The point at `n` periods and V [m/s], by Newton's method from `fast` on.

        Raises NoMapError where none is found, or its rates are not exact enough.
        """
        period_map, before = self.map, inf
        for _ in range(max_sequences):
            now = period_map.place(self.begin, velocity, fast, n)
            sections, modes = period_map.sections(now, ORDER, self.budget)
            self.maps += ORDER
            differences = _differences([period_map.numbers(section) for section in sections])
            correction = period_map.resolvent(ORDER, [-d for d in differences[ORDER][2:]])
            fast = [y + c for y, c in zip(fast, correction, strict=True)]
            size = period_map.size(correction)
            if size <= FAST_SHARE * period_map.tolerance:
                break
            if size > MAX_CONTRACTION * before:
                raise NoMapError
            before = size
        else:
            raise NoMapError
        acceleration, travel, *fast_rate = map(_rate, zip(*differences, strict=True))
        velocity, first, second, third = (d[0] for d in differences)
        terms = zip(differences[1][2:], differences[2][2:], strict=True)
        missing = period_map.size(
            period_map.resolvent(ORDER, [_next_term(*pair) for pair in terms])
        )
        error = _next_term(second, third) / (ORDER + 1)
        error += period_map.share * period_map.speed * (missing + size)
        if error > period_map.share * self.allowed:
            raise NoMapError
        gain = (second - third) / first if first else 0.0
        rates = acceleration, travel, fast_rate, gain
        return Point(n, velocity, fast, *rates, error, modes, sections)

    def rates(self, n: float, velocity: float) -> Rates:
        """The rates at `n` periods and V [m/s].

        Fast states are guessed along the tangent of the last point: by n where rates depend on
        that or are no larger than their error, by V elsewhere. Raises NoMapError where contact
        modes do not repeat as they did at the start of the step: the rates have a kink in between.
        """
        last = self.last
        if self.varies or abs(last.acceleration) <= last.error:
            way = n - last.n
        else:
            way = (velocity - last.velocity) / last.acceleration
        tangent = zip(last.fast, last.fast_rate, strict=True)
        found = self.point(n, velocity, [y + way * rate for y, rate in tangent])
        if found.modes != self.here.modes:
            raise NoMapError
        self.last = found
        return found.acceleration, found.travel

    def integrate(self, longest: float, error: float) -> tuple[float, float, float]:
        """Integrate over at most `longest` periods, as far as that goes.

        Returns the periods passed, the travel [m], and the error of the slow velocity [m/s], which
        is `error` before.
        """
        n, travel, h, gain = 0.0, 0.0, inf, abs(self.here.gain)
        if gain > 0.0:
            h = FIRST_STEP / gain * (self.allowed * gain / abs(self.here.acceleration)) ** 0.2
        in_beat = MAX_STEP_DRIFT / abs(self.map.drift) if self.varies else inf
        while True:
            here, to_grazing = self.here, inf
            if here.acceleration != 0.0:
                distance = abs(here.velocity) - self.map.speed
                to_grazing = TO_GRAZING * abs(distance / here.acceleration)
            h = float(floor(min(h, in_beat, to_grazing, longest - n)))
            if h < SHORTEST_STEP:
                return n, travel, error
            try:
                passed, to, of_step = self._step(n, h, longest - n)
            except (ArithmeticError, ValueError, Refusal):
                h = 0.5 * h
                continue
            if of_step <= self.allowed:
                # Without drift V obeys V' = g(V): its errors grow and decay as g does.
                known = not self.varies and here.acceleration != 0.0
                decay = min(1.0, abs(self.last.acceleration / here.acceleration)) if known else 1.0
                error = decay * error + of_step + passed * max(here.error, self.last.error)
                n, travel = n + passed, travel + to.travel
                self.here = self.last
            h = passed * step_growth(of_step, self.allowed)

    def _step(self, n: float, h: float, left: float) -> tuple[float, Step, float]:
        """All periods that are `left` in one step near a steady velocity, or `h` of them.

        Returns the periods passed, where they lead, and the error of the step [m/s].
        """
        self.last = here = self.here
        first = here.acceleration, here.travel
        if not self.varies:
            max_change = LINEAR * sqrt(self.map.tolerance) * self.map.speed
            with suppress(NoMapError):
                to = linear_step(self.rates, n, here.velocity, left, first, here.gain, max_change)
                if to is not None and to.error <= self.allowed:
                    return left, to, to.error
            self.last = here
        to = dormand_prince(self.rates, n, here.velocity, h, first)
        missed = HERMITE_SHARE * _hermite_error(here, self.last, h)
        return h, to, ERROR_SHARE * max(to.error, missed)


class Leaping(Resolved):
    """Motion of the full device that leaps over periods (methods as of `Resolved`)."""

    def __init__(self, system: System) -> None:
        super().__init__(system)
        self._map: PeriodMap | None = None
        # Undamped resonance has no steady vibration: all is resolved.
        with suppress(Refusal, NoMapError):
            period_map = PeriodMap(system, MAX_TURNS)
            if abs(period_map.drift) * SHORTEST_STEP <= MAX_STEP_DRIFT:
                self._map = period_map

    def advance(self, moment: Moment, duration: float) -> Moment:
        """As of `Resolved`."""
        budget, clock, now, left, pause = Budget(duration), Clock(duration), moment, duration, 0.0
        period_map, w = self._map, self.system.drive_frequency
        while period_map is not None and left > (SHORTEST_LEAP + pause) * period_map.period:
            wait = pause * period_map.period + (period_map.section - now.theta) % tau / w
            if wait > 0.0:
                now, left = self.resolve(now, wait, budget), clock.advance(wait)
            now = now.copied()
            now.theta = period_map.section
            longest = floor(left / period_map.period)
            now, passed, pause = _leap(period_map, now, longest, budget)
            left = clock.advance(passed * period_map.period)
        return self.resolve(now, left, budget) if left > 0.0 else now


def _leap(
    period_map: PeriodMap, begin: Moment, longest: float, budget: Budget
) -> tuple[Moment, float, float]:
    """Leap from a moment at the section over at most `longest` periods.

    Returns the moment a few resolved periods behind the landing, the periods passed, and how many
    are to be resolved before the next leap.
    """
    now, passed, maps = begin, 0.0, ORDER
    with suppress(ArithmeticError, ValueError, Refusal):
        slow = SlowMotion(period_map, begin, budget, longest)
        n, travel, error = slow.integrate(longest - ORDER, begin.leap_error)
        maps = slow.maps
        if n > 0.0:
            before, now = slow.here.sections[-2:]
            passed = n + ORDER
            now.position += travel
            now.leap_error = error
            now.reversals += round(n * (now.reversals - before.reversals))
            now.sticks += round(n * (now.sticks - before.sticks))
            if now.event_age >= ORDER * period_map.period:
                now.event_age += n * period_map.period
    return now, passed, max(MIN_PAUSE, PAUSE * (maps - passed))
