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

from .contact import MAX_TURNS_TO_REPEAT
from .device import System
from .moment import Moment
from .period_map import Numbers, PeriodMap
from .resolved import Resolved
from .slow_equation import NoRatesError, Rates, SlowEquation
from .values import Budget, Refusal

ORDER = 3
"""Order of the differences: a sequence maps so many periods."""

FAST_SHARE = 0.3
"""Share of the tolerance for errors of the fast states."""

ERROR_SHARE = 0.3
"""Error of the solver's result, of order 5, over its estimate, of order 4: 0.2 and a margin."""

SHORTEST_STEP = 12.0 * ORDER
"""Fewest periods of a step: its seven evaluations map some half as many."""

SHORTEST_LEAP = 64.0
"""Fewest periods that may be left for a leap."""

PAUSE = 12.0
"""Periods that are resolved after an attempt, by period mapped in vain, or by that of one sequence:
attempts cost a twelfth of resolved motion at most. In them kinks pass and transients decay."""


class Point(NamedTuple):
    """A point of the slow manifold, after a number of periods.

    The fast states; the rates of V [m/s] and of the position [m] by period, and the error of the
    former; the contact `modes` over a sequence and the moments at its `sections`.
    """

    fast: Numbers
    rates: Rates
    error: float
    modes: list[int]
    sections: list[Moment]


def _differences(a: float, b: float, c: float, d: float) -> tuple[float, float, float]:
    """The first, second and third difference of a sequence."""
    return b - a, c - 2.0 * b + a, (d - a) - 3.0 * (c - b)


class SlowMotion:
    """The slow motion from the moment `begin` at the section on.

    `here` is the point where the present step of the solver begins, `last` the one found last;
    `maps` counts mapped periods.
    """

    def __init__(self, period_map: PeriodMap, begin: Moment, budget: Budget) -> None:
        """Raises NoRatesError for a moment off the manifold."""
        self.map, self.begin, self.budget, self.maps = period_map, begin, budget, 0
        self.velocity, *fast, _ = period_map.numbers(begin)
        self.here = self.last = self._point(0.0, self.velocity, fast, before=0.0)

    def leap(self, longest: float) -> tuple[Moment, float]:
        """The moment behind up to `longest` periods and ORDER resolved ones, and their number.

        Along the leap the error of V is added up. It is the moment `begin` where no step holds.
        """
        speed, drift, share, landing = self.map.speed, self.map.drift, self.map.share, self.begin
        slow_time, beat = 1.0 / share if share else inf, tau / abs(drift) if drift else inf
        tolerance = self.map.tolerance / ERROR_SHARE
        equation = SlowEquation(self._rates, speed, tolerance, slow_time, beat, SHORTEST_STEP)
        n, travel, error = 0.0, 0.0, landing.leap_error
        for step in equation.steps(self.velocity, self.here.rates, longest):
            here, self.here = self.here, self.last
            # Without drift V obeys V' = g(V): its errors grow and decay as g does.
            before, after = here.rates[0], self.here.rates[0]
            error *= min(1.0, abs(after / before)) if before and not drift else 1.0
            error += ERROR_SHARE * step.error + step.length * max(here.error, self.here.error)
            n, travel = n + step.length, travel + step.travel
        if n == 0.0:
            return landing, 0.0
        last_but_one, landing = self.here.sections[-2:]
        landing.position += travel
        landing.leap_error = error
        landing.reversals += round(n * (landing.reversals - last_but_one.reversals))
        landing.time += n * self.map.period
        if landing.last_event_time > self.begin.time:
            landing.last_event_time += n * self.map.period
        return landing, n + ORDER

    def _rates(self, n: float, velocity: float) -> Rates:
        """The rates at `n` periods and V [m/s].

        Raises NoRatesError where contact modes are not those at the start of the step: at a kink.
        """
        try:
            found = self._point(n, velocity, self.last.fast)
        except (ArithmeticError, ValueError, Refusal):
            raise NoRatesError from None
        if found.modes != self.here.modes:
            raise NoRatesError
        self.last = found
        return found.rates

    def _point(self, n: float, velocity: float, fast: Numbers, before: float = inf) -> Point:
        """The point at `n` periods and V [m/s], by Newton's method from `fast` on.

        After a correction of size `before`. Raises NoRatesError where none is found, or its rates
        are not exact enough.
        """
        period_map, size = self.map, inf
        while size > FAST_SHARE * period_map.tolerance:
            now = period_map.place(self.begin, velocity, fast, n)
            sections, modes = period_map.sections(now, ORDER, self.budget)
            self.maps += ORDER
            sequences = zip(*map(period_map.numbers, sections), strict=True)
            slow, *others, moved = (_differences(*sequence) for sequence in sequences)
            correction = period_map.resolvent(ORDER, [-third for _, _, third in others])
            fast = [y + c for y, c in zip(fast, correction, strict=True)]
            fast_scale = period_map.scale[1:-1]
            size = max(abs(c) / scale for c, scale in zip(correction, fast_scale, strict=True))
            if size > max(0.5 * before, FAST_SHARE * period_map.tolerance):
                raise NoRatesError  # Newton's method does not converge.
            before = size
        # Rates are the logarithm of the shift operator. Its next term is that by which they err, if
        # terms go on to shrink as they did, beside the last correction.
        acceleration, travel = (b - c / 2.0 + d / 3.0 for b, c, d in (slow, moved))
        second, third = abs(slow[1]), abs(slow[2])
        error = third * min(1.0, third / second if second else 1.0) / (ORDER + 1)
        error += period_map.share * period_map.speed * size
        if error > period_map.share * period_map.speed * period_map.tolerance:
            raise NoRatesError
        return Point(fast, (acceleration, travel), error, modes, sections)


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
            left -= wait
            passed, maps = 0.0, ORDER
            with suppress(ArithmeticError, ValueError, Refusal):
                slow = SlowMotion(period_map, now, budget)
                now, passed = slow.leap(floor(left / period_map.period) - ORDER)
                maps = slow.maps
            left -= passed * period_map.period
            pause = PAUSE * max(ORDER, maps - passed)
        return self.resolve(now, left, budget)
