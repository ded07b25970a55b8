"""A damped oscillator under a constant and sinusoidal forcing, from any state, regular everywhere.

Steady responses of moderate size are split off. The rest is a free motion plus responses from rest:
to the constant, to forcing that resonates, and to slow forcing of a slow oscillator.
"""

from __future__ import annotations

from cmath import rect
from collections.abc import Callable
from dataclasses import dataclass
from math import hypot, inf

from .oscillator import (
    SLOW,
    Oscillator,
    free_response,
    resonates,
    response_from_rest,
    slow_response_from_rest,
    step_response,
    transfer,
)

AHEAD = 5.0
"""Horizon of the bounds of responses from rest, as an angle [rad] of the highest frequency: longer
than most slides."""

Response = Callable[[Oscillator, float, float], tuple[complex, complex]]


@dataclass(frozen=True, slots=True)
class Sample:
    """Displacement y [m] and derivatives, with bounds on |y'| to |y'''| over the horizon."""

    displacement: float
    rate: float
    acceleration: float
    rate_bound: float
    acceleration_bound: float
    jerk_bound: float


class ForcedOscillator:
    """y'' + 2 decay y' + stiffness y = constant + sum of Re(amplitude exp(i frequency t)).

    `forcing` lists (frequency [rad/s], complex amplitude [m/s^2]); the motion starts at
    displacement `y0` [m] and rate `u0` [m/s]. Slow forcing of a slow oscillator, both compared with
    `fastest` [rad/s], is followed from rest too; `sample` is then valid for times up to 60 /
    fastest.
    """

    __slots__ = (
        "_constant",
        "_forcing",
        "_free",
        "_from_rest",
        "_oscillator",
        "_steady",
        "horizon",
    )

    def __init__(
        self,
        oscillator: Oscillator,
        constant: float,
        forcing: tuple[tuple[float, complex], ...],
        y0: float,
        u0: float,
        fastest: float,
    ) -> None:
        steady = []
        from_rest: list[tuple[float, complex, Response]] = []
        slow = max(oscillator.frequency, oscillator.decay) < SLOW * fastest
        for frequency, amplitude in forcing:
            if frequency == 0.0:
                constant += amplitude.real
            elif slow and abs(frequency) < SLOW * fastest:
                from_rest.append((frequency, amplitude, slow_response_from_rest))
            elif resonates(oscillator, frequency):
                folded = amplitude if frequency > 0.0 else amplitude.conjugate()
                from_rest.append((abs(frequency), folded, response_from_rest))
            else:
                response = amplitude * transfer(oscillator, frequency)
                steady.append((frequency, response))
                y0 -= response.real
                u0 += frequency * response.imag
        self._oscillator = oscillator
        self._constant = constant
        self._forcing = forcing
        self._steady = tuple(steady)
        self._from_rest = tuple(from_rest)
        self._free = (y0, u0)
        rates = [oscillator.frequency, *(abs(f) for f, _, _ in from_rest)]
        self.horizon = AHEAD / max(rates) if from_rest else inf

    def sample(self, t: float) -> Sample:
        """Motion at `t` >= 0 [s].

        The energy of the free part never grows, so that at `t` bounds it later.
        """
        oscillator = self._oscillator
        decay, stiffness, frequency = oscillator.decay, oscillator.stiffness, oscillator.frequency
        y, u = self._free_motion(t)
        acceleration = self._constant - 2.0 * decay * u - stiffness * y
        jerk_bound = hypot(2.0 * decay * acceleration + stiffness * u, frequency * acceleration)
        acceleration_bound = jerk_bound / frequency
        rate_bound = hypot(u, acceleration / frequency)
        for f, response in self._steady:
            turned = response * rect(1.0, f * t)
            y += turned.real
            u -= f * turned.imag
            rate_bound += abs(f * response)
            size = abs(response) * f * f
            acceleration_bound += size
            jerk_bound += size * abs(f)
        for f, amplitude, response_to in self._from_rest:
            displacement, rate = response_to(oscillator, f, t)
            y += (amplitude * displacement).real
            u += (amplitude * rate).real
            ahead = t + self.horizon
            size = abs(amplitude) * (abs(f) + 2.0 * decay + frequency + ahead * f * f)
            rate_bound += abs(amplitude) * ahead
            acceleration_bound += size / frequency
            jerk_bound += size
        acceleration = -2.0 * decay * u - stiffness * y
        if self._constant:
            acceleration += self._constant
        for f, amplitude in self._forcing:
            if f != 0.0:
                acceleration += (amplitude * rect(1.0, f * t)).real
        return Sample(y, u, acceleration, rate_bound, acceleration_bound, jerk_bound)

    def reach(self) -> tuple[float, float]:
        """Bounds on |displacement| and |rate| for all time; infinite without a steady response."""
        if self._from_rest:
            return inf, inf
        y0, u0 = self._free
        frequency = self._oscillator.frequency
        offset = self._constant / self._oscillator.stiffness
        rate = hypot(u0, frequency * (y0 - offset))
        displacement = rate / frequency + abs(offset)
        for f, response in self._steady:
            displacement += abs(response)
            rate += abs(f * response)
        return displacement, rate

    def _free_motion(self, t: float) -> tuple[float, float]:
        """Motion under the constant forcing alone."""
        oscillator = self._oscillator
        cosine, sine = free_response(oscillator, t)
        y0, u0 = self._free
        decay = oscillator.decay
        y = y0 * (cosine + decay * sine) + u0 * sine
        u = u0 * (cosine - decay * sine) - oscillator.stiffness * y0 * sine
        if self._constant:
            displacement, rate = step_response(oscillator, t)
            y += self._constant * displacement
            u += self._constant * rate
        return y, u
