"""Motion that leaps over periods: fidelity 0, averages of second order.

A step of the host resolves the motion to the next section of the period map, leaps over a whole
number of periods, and resolves the last ones: outputs, events and state are those of resolved
motion. Where a leap gains nothing or does not hold, motion stays resolved.

In a leap the slow velocity V obeys dV/dn = g(V, n), n being the number of periods. g is that on the
slow manifold, where the fast states follow V smoothly: their differences of high order over the
periods vanish (Gear, Kaper, Kevrekidis, Zagaris 2005).
"""

from contextlib import suppress
from math import floor, inf, tau
from typing import NamedTuple

from .budget import Budget
from .device import System
from .moment import Moment
from .period_map import Fast, PeriodMap
from .resolved import Resolved
from .slow_equation import NoRatesError, Rates, SlowEquation
from .values import Refusal
from .vibrating_load import MAX_TURNS_TO_REPEAT

ORDER = 3
"""Order of the differences: a sequence maps so many periods."""

MAX_CONTRACTION = 0.5
"""Largest ratio of successive corrections by which Newton's method converges."""

FAST_SHARE = 0.3
"""Share of the tolerance for errors of the fast states."""

ERROR_SHARE = 0.3
"""Error of the solver's result, of order 5, over its estimate, of order 4: 0.2 and a margin."""

SHORTEST_STEP = 12.0 * ORDER
"""Fewest periods of a step: its seven evaluations map some half as many."""

SHORTEST_LEAP = 64.0
"""Fewest periods that may be left for a leap."""

TO_GRAZING = 0.5
"""Part of the way to a grazing velocity that a step may pass: there rates are singular."""

PAUSE = 12.0
"""Periods that are resolved after an attempt, by period mapped in vain, or by that of one sequence:
attempts cost a twelfth of resolved motion at most. In them kinks pass and transients decay."""


class Point(NamedTuple):
    """A point of the slow manifold, after a number of periods.

    The slow `velocity` [m/s] and the fast states; the rates of V and of the position by period, and
    the error of the former; the contact `modes` over a sequence and the moments at its `sections`.
    """

    velocity: float
    fast: Fast
    acceleration: float
    travel: float
    error: float
    modes: list[int]
    sections: list[Moment]


def _third(a: float, b: float, c: float, d: float) -> float:
    """The third difference of a sequence."""
    return (d - a) - 3.0 * (c - b)


def _rate(a: float, b: float, c: float, d: float) -> float:
    """Rate of a smooth sequence: the logarithm of the shift operator, a series of differences."""
    return (b - a) - (c - 2.0 * b + a) / 2.0 + _third(a, b, c, d) / 3.0


class SlowMotion:
    """The slow motion from the moment `begin` at the section on.

    `here` is the point where the present step of the solver begins, `last` the one found last;
    `maps` counts mapped periods.
    """

    def __init__(self, period_map: PeriodMap, begin: Moment, budget: Budget) -> None:
        """Raises NoRatesError for a moment off the manifold."""
        self.map, self.begin, self.budget, self.maps = period_map, begin, budget, 0
        velocity, _, *fast = period_map.numbers(begin)
        self.here = self.last = self.point(0.0, velocity, fast, before=0.0)

    def point(self, n: float, velocity: float, fast: Fast, before: float = inf) -> Point:
        """The point at `n` periods and V [m/s], by Newton's method from `fast` on.

        After a correction of size `before`. Raises NoRatesError where none is found, or its rates
        are not exact enough.
        """
        period_map, size = self.map, inf
        while size > FAST_SHARE * period_map.tolerance:
            now = period_map.place(self.begin, velocity, fast, n)
            sections, modes = period_map.sections(now, ORDER, self.budget)
            self.maps += ORDER
            numbers = list(zip(*map(period_map.numbers, sections), strict=True))
            correction = period_map.resolvent(ORDER, [-_third(*of) for of in numbers[2:]])
            fast = [y + c for y, c in zip(fast, correction, strict=True)]
            size = period_map.size(correction)
            if size > max(MAX_CONTRACTION * before, FAST_SHARE * period_map.tolerance):
                raise NoRatesError
            before = size
        # The next term of the rate, if terms go on to shrink as they did, and the correction's.
        a, b, c, _ = numbers[0]
        second, third = abs(c - 2.0 * b + a), abs(_third(*numbers[0]))
        error = third * min(1.0, third / second if second else 1.0) / (ORDER + 1)
        error += period_map.share * period_map.speed * size
        if error > period_map.share * period_map.speed * period_map.tolerance:
            raise NoRatesError
        return Point(a, fast, _rate(*numbers[0]), _rate(*numbers[1]), error, modes, sections)

    def rates(self, n: float, velocity: float) -> Rates:
        """The rates at `n` periods and V [m/s].

        Raises NoRatesError where contact modes do not repeat as they did at the start of the step:
        the rates have a kink in between.
        """
        try:
            found = self.point(n, velocity, self.last.fast)
        except (ArithmeticError, ValueError, Refusal):
            raise NoRatesError from None
        if found.modes != self.here.modes:
            raise NoRatesError
        self.last = found
        return found.acceleration, found.travel

    def integrate(self, longest: float, error: float) -> tuple[float, float, float]:
        """Return up to `longest` periods that a leap passes, the travel [m], and the error of V."""
        speed, drift, n, travel = self.map.speed, self.map.drift, 0.0, 0.0

        def longest_step(velocity: float, acceleration: float) -> float:
            to_grazing = TO_GRAZING * abs(abs(velocity) - speed)
            return to_grazing / abs(acceleration) if acceleration else inf

        equation = SlowEquation(
            self.rates,
            speed,
            self.map.tolerance / ERROR_SHARE,
            slow_time=1.0 / self.map.share if self.map.share else inf,
            beat=tau / abs(drift) if drift else inf,
            longest=longest_step,
            shortest=SHORTEST_STEP,
        )
        first = self.here.acceleration, self.here.travel
        for step in equation.steps(self.here.velocity, first, longest):
            here, self.here = self.here, self.last
            # Without drift V obeys V' = g(V): its errors grow and decay as g does.
            known = not drift and here.acceleration != 0.0
            decay = min(1.0, abs(self.here.acceleration / here.acceleration)) if known else 1.0
            error = decay * error + ERROR_SHARE * step.error
            error += step.length * max(here.error, self.here.error)
            n, travel = n + step.length, travel + step.travel
        return n, travel, error


class Leaping(Resolved):
    """Motion of the full device that leaps over periods (methods as of `Resolved`)."""

    def __init__(self, system: System) -> None:
        super().__init__(system)
        self._map: PeriodMap | None = None
        # Undamped resonance has no steady vibration: all is resolved.
        with suppress(Refusal, NoRatesError):
            self._map = PeriodMap(system, MAX_TURNS_TO_REPEAT)

    def advance(self, moment: Moment, duration: float) -> Moment:
        """As of `Resolved`."""
        budget, now, left, pause = Budget(duration, moment.time), moment, duration, 0.0
        period_map, w = self._map, self.system.drive_frequency
        while period_map is not None and left > (SHORTEST_LEAP + pause) * period_map.period:
            wait = pause * period_map.period + (period_map.section - now.theta) % tau / w
            now = self.resolve(now, wait, budget)
            now.theta = period_map.section
            longest = floor((left - wait) / period_map.period)
            now, passed, pause = _leap(period_map, now, longest, budget)
            left -= wait + passed * period_map.period
        return self.resolve(now, left, budget)


def _leap(
    period_map: PeriodMap, begin: Moment, longest: float, budget: Budget
) -> tuple[Moment, float, float]:
    """Leap from a moment at the section over at most `longest` periods.

    Returns the moment a few resolved periods behind the landing, the periods passed, and how many
    are to be resolved before the next leap.
    """
    now, passed, maps = begin, 0.0, ORDER
    with suppress(ArithmeticError, ValueError, Refusal):
        slow = SlowMotion(period_map, begin, budget)
        n, travel, error = slow.integrate(longest - ORDER, begin.leap_error)
        maps = slow.maps
        if n > 0.0:
            before, now = slow.here.sections[-2:]
            passed = n + ORDER
            now.position += travel
            now.leap_error = error
            now.reversals += round(n * (now.reversals - before.reversals))
            now.sticks += round(n * (now.sticks - before.sticks))
            now.time += n * period_map.period
            if now.last_event_time > begin.time:
                now.last_event_time += n * period_map.period
    return now, passed, PAUSE * max(ORDER, maps - passed)
