"""Motion that leaps over periods: fidelity 0, averages of second order.

The motion is resolved to the next section of the period map, leaps over a whole number of periods,
and is resolved again for the last ones: outputs, events and state are those of resolved motion.
Where leaping gains nothing or does not hold, motion stays resolved.

In a leap the slow velocity V obeys dV/dn = g(V, n), n being the number of periods. g comes from the
slow manifold, on which the fast states follow V smoothly: their differences of high order over the
periods vanish (Gear, Kaper, Kevrekidis, Zagaris 2005).
"""

from __future__ import annotations

from collections.abc import Iterable
from contextlib import suppress
from dataclasses import dataclass, field
from itertools import pairwise
from math import ceil, exp, expm1, floor, inf, log, pi, sqrt, tau
from typing import NamedTuple

from .budget import Budget, Clock
from .device import System, Vibration, vibration
from .dormand_prince import Rates, Step, dormand_prince, step_growth
from .events import advance
from .moment import Moment
from .motion import Resolved
from .period_map import Fast, NoMapError, PeriodMap, fast_of
from .values import Refusal

ORDERS = range(3, 6)
"""Orders of differences, the lowest one first."""

MAX_SEQUENCES = 6
"""Largest number of sequences that one evaluation maps."""

SHRINKS = 0.5
"""Largest factor by which corrections shrink."""

EVALUATIONS = 6.0
"""Evaluations in a step of the solver."""

MAX_COST = 0.5
"""Share of the leapt periods that they may map: the rest is the gain."""

SHORTEST_STEP = 16.0
"""Fewest periods of a step: its evaluations would map more."""

FIRST_STEP = 3.3
"""First step of the solver, over the time in which rates change, where all that the slow velocity
still changes by is the tolerance."""

STEP_TOLERANCE = 4.0
"""Estimated error of a step that is accepted, in tolerances."""

OVERESTIMATE = 5.0
"""By how much that estimate, of the embedded method of order 4, exceeds the error."""

FAST_SHARE = 0.3
"""Share of the tolerance for errors of the fast states."""

MAX_TRANSIENT = 1e-6
"""Largest transient that a leap leaves out, over the scales of the fast states: so small that
outputs of the resonator do not show it."""

TO_GRAZING = 0.5
"""Part of the way to a grazing velocity that a step may pass: the rates are singular there."""

MAX_STEP_DRIFT = pi / 4.0
"""Largest drift of the load's phase [rad] in a step: its stages then see all phases of a beat."""

LINEAR = 0.3
"""Change of V up to which its rate may be linear, over v_q and the root of the tolerance."""

NO_DECAY = 1e-6
"""Decay of V in a step below which its rate counts as constant."""

MAX_DECAY = 4.0
"""Largest decay of V in a period, over the share of friction: beyond, it is noise."""

NO_DRIFT = 1e-9
"""Drift of the load's phase [rad] over a leap up to which its rates depend on V alone."""

STILL = 1e-9
"""Acceleration, over that under full friction, up to which the motion is steady."""

FARTHEST = 8.0
"""How far fast states are extrapolated by a cubic, over the distance of its two points."""

MAX_TURNS = 4
"""Largest number of turns after which the normal load may repeat."""

SHORTEST_LEAP = 64.0
"""Fewest periods that may be left for a leap."""

PAUSE = 8.0
"""Periods that are resolved after an attempt, by period mapped in vain: attempts cost an eighth of
resolved motion at most."""

MIN_PAUSE = 32.0
"""Fewest periods that are resolved after an attempt that gained nothing."""


class Point(NamedTuple):
    """A point of the slow motion, `n` periods after the start of a leap.

    The slow `velocity` [m/s]; changes by period of it [m/s], of the position [m] (`travel`), of the
    acceleration (`jerk`), of the fast states and of the counts; the estimated `error` of the
    acceleration; the contact `modes` of the sequence, and the moment `order` periods `later`.
    """

    n: float
    velocity: float
    acceleration: float
    travel: float
    jerk: float
    fast: Fast
    fast_rate: Fast
    error: float
    offset: float
    reversals: int
    sticks: int
    modes: list[int]
    later: Moment


class OffManifoldError(NoMapError):
    """The fast states are `offset` off the slow manifold, over their scales."""

    def __init__(self, offset: float, later: Moment) -> None:
        super().__init__(offset)
        self.offset, self.later = offset, later


def _differences(numbers: list[float]) -> list[float]:
    """Differences of all orders at the begin of a sequence."""
    found = []
    while numbers:
        found.append(numbers[0])
        numbers = [after - before for before, after in pairwise(numbers)]
    return found


def _rate(differences: list[float]) -> float:
    """Rate per period of a smooth sequence: the logarithm of the shift operator."""
    return sum((-d if j % 2 == 0 else d) / j for j, d in enumerate(differences) if j > 0)


def _next_term(before: float, last: float) -> float:
    """Size of the next term after a term `last`, if terms go on to shrink as they did."""
    before, last = abs(before), abs(last)
    return last * (last / before) if before > last else last


@dataclass(slots=True)
class SlowMotion:
    """The slow motion from a moment at the section, at normal phase `psi` [rad].

    `varies`: its rates depend on time, too. Fast states are put on the manifold to within
    `allowed`, over their scales, by at most `max_sequences` of `order` periods; `maps` counts
    periods. They are extrapolated from two points, that where the present step begins (`here`) and
    another.
    """

    map: PeriodMap
    begin: Moment
    budget: Budget
    varies: bool
    allowed: float
    tolerance: float
    order: int = ORDERS[0]
    max_sequences: int = 1
    maps: int = 0
    here: Point = field(init=False)
    other: Point = field(init=False)

    def point(self, n: float, velocity: float, fast: Fast) -> Point:
        """The point at `n` periods and V [m/s], from a first guess of the fast states on.

        Raises NoMapError where the manifold is not found.
        """
        period_map, psi = self.map, self.map.psi_after(self.begin.psi, n)
        steps: list[Fast] = []
        offset, before = 0.0, inf
        for _ in range(self.max_sequences):
            now = period_map.place(self.begin, velocity, fast, psi)
            self.maps += self.order
            visits, modes = period_map.visits(now, self.order, self.budget)
            parts = [_differences([fast_of(v)[i] for v in visits]) for i in range(3)]
            step = period_map.homing(self.order, _fast(-d[-1] for d in parts))
            beyond = period_map.homing(self.order, _fast(_next_term(d[-3], d[-2]) for d in parts))
            size = period_map.size(step)
            offset = offset or size
            if size <= self.allowed:
                speeds = _differences([period_map.slow_velocity(v) for v in visits])
                places = _differences([v.position - now.position for v in visits])
                error = _next_term(speeds[-2], speeds[-1]) / (self.order + 1)
                missing = period_map.share * period_map.speed * (period_map.size(beyond) + size)
                return Point(
                    n,
                    velocity,
                    _rate(speeds),
                    _rate(places),
                    speeds[2] - speeds[3],
                    _sum(fast, step),
                    _fast(_rate(d) for d in parts),
                    error + missing,
                    offset,
                    visits[-1].reversals - visits[-2].reversals,
                    visits[-1].sticks - visits[-2].sticks,
                    modes,
                    visits[-1],
                )
            if not size <= SHRINKS * before:
                break
            before = size
            steps.append(self._improved(step, steps))
            fast = _sum(fast, steps[-1])
        raise OffManifoldError(offset, visits[-1])

    def _improved(self, step: Fast, steps: list[Fast]) -> Fast:
        """The next step by Broyden's method, with `homing` as the first inverse Jacobian."""
        scale = self.map.scale
        for j, earlier in enumerate(steps):
            square = sum((e / s) ** 2 for e, s in zip(earlier, scale, strict=True))
            product = sum(e * x / s / s for e, x, s in zip(earlier, step, scale, strict=True))
            share = product / square if square > 0.0 else 0.0
            if j + 1 < len(steps):
                step = _sum(step, _fast(share * x for x in steps[j + 1]))
            else:
                step = _fast(x / (1.0 - share) for x in step)
        return step

    def rates(self, n: float, velocity: float) -> Rates:
        """The rates at `n` periods and V [m/s].

        There are none where sliding does not repeat as it did at the start of the step: they have a
        kink in between.
        """
        found = self.point(n, velocity, self._guess(n, velocity))
        if found.modes != self.here.modes:
            raise NoMapError
        self.other = found
        return found.acceleration, found.travel

    def _guess(self, n: float, velocity: float) -> Fast:
        """Fast states by Hermite's cubic through two points, or along the tangent of one.

        As a function of V or, under rates that vary, of the number of periods.
        """
        a, b = self.here, self.other
        if self.varies:
            way, width = n - a.n, b.n - a.n
        else:
            way, width = velocity - a.velocity, b.velocity - a.velocity
        guess, s = [], way / width if width else inf
        for i in range(3):
            tangent, there = self._slope(a, i), self._slope(b, i)
            value = a.fast[i] + tangent * way
            if abs(s) < FARTHEST:
                rise = b.fast[i] - a.fast[i] - width * tangent
                bend = width * (there - tangent)
                value += s * s * (3.0 * rise - bend + s * (bend - 2.0 * rise))
            guess.append(value)
        return _fast(guess)

    def _slope(self, point: Point, i: int) -> float:
        if self.varies:
            return point.fast_rate[i]
        moves = abs(point.acceleration) > STILL * self.map.share * self.map.speed
        return point.fast_rate[i] / point.acceleration if moves else 0.0

    def first_step(self, longest: float) -> float:
        """Put the start on the manifold and return the first step to be tried, in periods.

        With the lowest order at which the rates are accurate enough. 0 where nothing would be
        gained.
        """
        here, period_map = self.here, self.map
        # A rate below its error does not tell when it changes.
        moves = abs(here.acceleration) > here.error and here.jerk != 0.0
        time = abs(here.acceleration / here.jerk) if moves else inf
        time, step = min(time, 1.0 / abs(period_map.drift) if self.varies else inf), inf
        if time < inf and here.acceleration:
            change = abs(here.acceleration) * time / period_map.speed
            step = min(FIRST_STEP * time * float((self.tolerance / change) ** 0.2), self._in_beat)
        placed = here.offset <= FAST_SHARE * self.tolerance
        self.max_sequences, self.allowed = MAX_SEQUENCES, FAST_SHARE * self.tolerance
        for self.order in ORDERS:
            evaluations = EVALUATIONS * self.order * (ceil(longest / step) if step < longest else 1)
            if evaluations > MAX_COST * longest:
                return 0.0
            if not placed:
                self.here = self.point(0.0, here.velocity, here.fast)
            placed = False
            if self.here.error * min(time, longest) <= self.tolerance * period_map.speed:
                return step
        return 0.0

    @property
    def _in_beat(self) -> float:
        """Periods that a step may pass of a beat, in which the load's phase drifts by a turn."""
        return MAX_STEP_DRIFT / abs(self.map.drift) if self.varies else inf

    def integrate(self, longest: float, step: float, error: float) -> tuple[float, float, float]:
        """Integrate over at most `longest` periods, as far as that goes.

        Returns the periods passed, the travel [m], and the error of the slow velocity [m/s], which
        is `error` before.
        """
        speed, n, travel = self.map.speed, 0.0, 0.0
        allowed = STEP_TOLERANCE * self.tolerance * speed
        while True:
            here, to_grazing = self.here, inf
            if here.acceleration:
                distance = abs(abs(here.velocity) - speed)
                to_grazing = TO_GRAZING * distance / abs(here.acceleration)
            h = float(floor(min(step, to_grazing, self._in_beat, longest - n)))
            if h < SHORTEST_STEP:
                return n, travel, error
            try:
                to, exceeds = self._linear_step(here, n, longest - n), 1.0
                if to is not None:
                    h = longest - n
                else:
                    exceeds = OVERESTIMATE
                    first = here.acceleration, here.travel
                    to = dormand_prince(self.rates, n, here.velocity, h, first)
            except (NoMapError, ArithmeticError, ValueError):
                self.other, step = here, 0.5 * h
                continue
            step = h * step_growth(to.error, allowed)
            if to.error <= allowed:
                gain = max(to.gain, -MAX_DECAY * self.map.share)
                decay = exp(gain * h) if gain < 0.0 else 1.0
                of_rates = h * max(here.error, self.other.error)
                error = decay * error + to.error / exceeds + of_rates
                n, travel = n + h, travel + to.travel
                self.here = self.other
            self.other = here

    def _linear_step(self, here: Point, n: float, h: float) -> Step | None:
        """The rest of a leap in one step of `h` periods, near a steady velocity.

        V changes so little that its rate is linear in it. None unless the rate at the end confirms
        that.
        """
        z = h * min(0.0, here.jerk / here.acceleration) if here.acceleration else 0.0
        decayed = exp(z)
        mean = expm1(z) / z if z < -NO_DECAY else 1.0
        change, speed = h * here.acceleration * mean, self.map.speed
        if self.varies or abs(change) > LINEAR * sqrt(self.tolerance) * speed:
            return None
        end = self.rates(n + h, here.velocity + change)
        error = h * mean * abs(end[0] - decayed * here.acceleration)
        if error > self.tolerance * speed:
            return None
        weight = (mean - decayed) / (1.0 - decayed) if z < -NO_DECAY else 0.5
        travel = h * (end[1] + weight * (here.travel - end[1]))
        return Step(here.velocity + change, travel, error, end, z / h)


def _fast(parts: Iterable[float]) -> Fast:
    y, u, bristle = parts
    return y, u, bristle


def _sum(a: Fast, b: Fast) -> Fast:
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


class Leaping(Resolved):
    """Motion of the full device that leaps over periods (methods as of `Resolved`)."""

    def __init__(self, system: System) -> None:
        super().__init__(system)
        self._vibration: Vibration | None = None
        # Undamped resonance has no steady vibration: all is resolved.
        with suppress(Refusal):
            self._vibration = vibration(system.device)

    def slow_motion_error(self, now: Moment) -> float:
        """What leaps have erred by so far in the slow velocity [m/s]."""
        return now.leap_error

    def advance(self, moment: Moment, duration: float) -> Moment:
        """As of `Resolved`."""
        budget, clock, now, left, pause = Budget(duration), Clock(duration), moment, duration, 0.0
        w = self.system.drive_frequency
        if self._vibration is not None and duration * w > SHORTEST_LEAP * tau:
            try:
                period_map = PeriodMap(self.system, self._vibration, MAX_TURNS)
                while left > (SHORTEST_LEAP + pause) * period_map.period:
                    to_section = (period_map.section - now.theta) % tau / w
                    wait = pause * period_map.period + to_section
                    if wait > 0.0:
                        now, left = advance(self.system, now, wait, budget), clock.advance(wait)
                    now = now.copied()
                    now.theta = period_map.section
                    longest = floor(left / period_map.period)
                    now, periods, pause = self._leap(period_map, now, longest, budget)
                    left = clock.advance(periods * period_map.period)
            except NoMapError:
                pass
        return advance(self.system, now, left, budget) if left > 0.0 else now

    def _leap(
        self, period_map: PeriodMap, now: Moment, longest: float, budget: Budget
    ) -> tuple[Moment, float, float]:
        """Leap from a moment at the section over at most `longest` periods.

        Returns the moment a few resolved periods behind the landing, the periods passed, and how
        many are to be resolved before the next attempt.
        """
        tolerance = self.system.device.tolerance
        varies = abs(period_map.drift) * longest > NO_DRIFT
        # The effect of a transient on V, for as long as it lasts, is a share of the tolerance.
        effect = period_map.share / (1.0 - period_map.decay)
        transient = min(MAX_TRANSIENT, FAST_SHARE * tolerance / effect if effect else inf)
        slow = SlowMotion(period_map, now, budget, varies, transient, tolerance)
        try:
            slow.here = slow.other = slow.point(0.0, period_map.slow_velocity(now), fast_of(now))
        except OffManifoldError as error:
            # Resolve until the transient has decayed.
            wait = log(error.offset / transient) / -log(period_map.decay)
            return error.later, float(slow.order), max(PAUSE, float(ceil(wait)))
        later, n, travel, error_now = slow.here.later, 0.0, 0.0, now.leap_error
        try:
            step = slow.first_step(longest - ORDERS[-1])
            slow.other = slow.here
            if step > 0.0:
                n, travel, error_now = slow.integrate(longest - slow.order, step, error_now)
        except (NoMapError, ArithmeticError, ValueError, Refusal):
            n = 0.0
        passed, gained = float(ORDERS[0]), n > 0.0
        if gained:
            later, passed = slow.here.later, n + slow.order
            later.position += travel
            later.leap_error = error_now
            later.reversals += round(n * slow.here.reversals)
            later.sticks += round(n * slow.here.sticks)
            if later.event_age >= slow.order * period_map.period:
                later.event_age += n * period_map.period
        in_vain = max(0.0, slow.maps - passed)
        return later, passed, PAUSE * in_vain if gained else max(MIN_PAUSE, PAUSE * in_vain)
