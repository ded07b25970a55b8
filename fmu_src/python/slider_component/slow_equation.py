"""The slow equation V' = a(V, t) by steps with error control, and in one step near a balance."""

from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass
from math import exp, expm1, floor, inf, isfinite, sqrt
from typing import NamedTuple

BEAT_SHARE = 0.125
"""Part of a beat that a step may have: its stages then see all phases of the normal load."""

Rates = tuple[float, float]
"""Rates of the velocity and of the travel."""


class NoRatesError(ArithmeticError):
    """There are no rates at a time and a velocity, or there is no slow motion at all."""


class Step(NamedTuple):
    """A step of some `length`: V at its end, the travel, its error of V, and rates at the end."""

    length: float
    velocity: float
    travel: float
    error: float
    rates: Rates


@dataclass(frozen=True)
class SlowEquation:
    """The slow velocity V with its travel.

    `rates` at a time and V raises NoRatesError where there are none. Steps may err by the
    `tolerance`, over the `speed`; in the `slow_time` rates may change V by that. Rates repeat after
    a `beat`; if that is infinite they depend on V alone. Steps are whole numbers of at least
    `shortest` that stay off grazing, where V is the speed, unless that is 0.
    """

    rates: Callable[[float, float], Rates]
    speed: float
    tolerance: float
    slow_time: float
    beat: float
    shortest: float = 0.0

    def steps(self, velocity: float, here: Rates, duration: float) -> Iterator[Step]:
        """The steps from a V, with the rates `here`, for a duration; they may end before."""
        t, gain, allowed = 0.0, 0.0, self.tolerance * self.speed
        size = max(self.shortest, 0.1 * self.slow_time)
        while t < duration and isfinite(velocity):
            to = None
            with suppress(NoRatesError):
                to = self._to_balance(t, velocity, duration - t, here, gain)
            if to is None:
                size = min(size, duration - t, BEAT_SHARE * self.beat)
                if self.shortest:
                    # At most half of the way to a grazing velocity: there rates are singular.
                    to_grazing = 0.5 * abs(abs(velocity) - self.speed)
                    size = floor(min(size, to_grazing / abs(here[0]) if here[0] else inf))
                    if size < self.shortest:
                        return
                try:
                    to = self._dormand_prince(t, velocity, size, here)
                except NoRatesError:
                    size *= 0.5
                    continue
                growth = 0.9 * (allowed / to.error) ** 0.2 if to.error > 0.0 else 5.0
                size *= min(5.0, max(0.2, growth))
            if not to.error > allowed:  # Not a number ends, too.
                yield to
                t += to.length
                changed = to.velocity - velocity
                gain = (to.rates[0] - here[0]) / changed if changed else 0.0
                velocity, here = to.velocity, to.rates

    def _to_balance(self, t: float, v: float, h: float, first: Rates, gain: float) -> Step:
        """A step, however long it is, near a balance: a is linear in V, with slope `gain` < 0.

        The rate at its end confirms it. Raises NoRatesError for too large a change of V or error.
        """
        if self.beat < inf or not gain * h < -1e-6:  # V hardly decays.
            raise NoRatesError
        (a, x), decayed, reach = first, exp(gain * h), expm1(gain * h) / gain
        allowed = self.tolerance * self.speed
        if abs(a * reach) > 0.3 * sqrt(allowed * self.speed):  # V changes too much.
            raise NoRatesError
        end = self.rates(t + h, v + a * reach)
        error = reach * abs(end[0] - decayed * a)
        if error > 0.1 * allowed:  # No other step corrects it.
            raise NoRatesError
        travel = h * end[1] + (x - end[1]) * (reach - h * decayed) / (1.0 - decayed)
        return Step(h, v + a * reach, travel, error, end)

    def _dormand_prince(self, t: float, v: float, h: float, first: Rates) -> Step:
        """A step of the pair 5(4), with the larger of its error and that by Simpson's rule.

        Where rates have a kink each may be small by accident, but not both.
        """
        rates, (a1, x1) = self.rates, first
        a2, _ = rates(t + h / 5, v + h * a1 / 5)
        a3, x3 = rates(t + 3 * h / 10, v + h * (3 * a1 + 9 * a2) / 40)
        a4, x4 = rates(t + 4 * h / 5, v + h * (44 * a1 / 45 - 56 * a2 / 15 + 32 * a3 / 9))
        slope = 19372 * a1 / 6561 - 25360 * a2 / 2187 + 64448 * a3 / 6561 - 212 * a4 / 729
        a5, x5 = rates(t + 8 * h / 9, v + h * slope)
        slope = 9017 * a1 / 3168 - 355 * a2 / 33 + 46732 * a3 / 5247 + 49 * a4 / 176
        a6, x6 = rates(t + h, v + h * (slope - 5103 * a5 / 18656))
        slope = 35 * a1 / 384 + 500 * a3 / 1113 + 125 * a4 / 192 - 2187 * a5 / 6784 + 11 * a6 / 84
        travel = 35 * x1 / 384 + 500 * x3 / 1113 + 125 * x4 / 192 - 2187 * x5 / 6784 + 11 * x6 / 84
        middle, _ = rates(t + h / 2, v + h * (slope / 2 + (a1 - a6) / 8))
        end = rates(t + h, v + h * slope)
        by_pair = 71 * a1 / 57600 - 71 * a3 / 16695 + 71 * a4 / 1920 - 17253 * a5 / 339200
        by_pair += 22 * a6 / 525 - end[0] / 40
        by_simpson = slope - (a1 + 4 * middle + end[0]) / 6
        error = h * max(abs(by_pair), abs(by_simpson))
        return Step(h, v + h * slope, h * travel, error, end)
