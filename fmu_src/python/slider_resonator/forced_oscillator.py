"""A damped oscillator under a constant and sinusoidal forcing, from any state, regular everywhere.

The steady responses are split off where they are bounded. What is left is a free motion plus, for
forcing that resonates, responses from rest.
"""

from __future__ import annotations

from cmath import rect
from dataclasses import dataclass
from math import hypot, inf

from .oscillator import Oscillator, free_response, resonates, response_from_rest, transfer


@dataclass(frozen=True, slots=True)
class Sample:
    """Displacement y [m] and derivatives, with bounds on |y''| and |y'''| over the horizon."""

    displacement: float
    rate: float
    acceleration: float
    acceleration_bound: float
    jerk_bound: float


class ForcedOscillator:
    """y'' + 2 decay y' + stiffness y = constant + sum of Re(amplitude exp(i frequency t)).

    `forcing` lists (frequency [rad/s], complex amplitude [m/s^2]); the motion starts at
    displacement `y0` [m] and rate `u0` [m/s].
    """

    __slots__ = ("_forcing", "_free", "_offset", "_oscillator", "_resonant", "_steady", "horizon")

    def __init__(
        self,
        oscillator: Oscillator,
        constant: float,
        forcing: tuple[tuple[float, complex], ...],
        y0: float,
        u0: float,
    ) -> None:
        steady = []
        resonant = []
        self._offset = constant / oscillator.stiffness
        y0 -= self._offset
        for frequency, amplitude in forcing:
            if resonates(oscillator, frequency):
                folded = amplitude if frequency > 0.0 else amplitude.conjugate()
                resonant.append((abs(frequency), folded))
            else:
                response = amplitude * transfer(oscillator, frequency)
                steady.append((frequency, response))
                y0 -= response.real
                u0 += frequency * response.imag
        self._oscillator = oscillator
        self._forcing = forcing
        self._steady = tuple(steady)
        self._resonant = tuple(resonant)
        self._free = (y0, u0)
        self.horizon = (
            1.0 / max(oscillator.frequency, *(f for f, _ in resonant)) if resonant else inf
        )

    def sample(self, t: float) -> Sample:
        """Motion at `t` >= 0 [s]. The free part loses energy, so its present energy bounds it."""
        oscillator = self._oscillator
        decay, stiffness, frequency = oscillator.decay, oscillator.stiffness, oscillator.frequency
        y, u = self._free_motion(t)
        acceleration = -2.0 * decay * u - stiffness * y
        jerk_bound = hypot(2.0 * decay * acceleration + stiffness * u, frequency * acceleration)
        acceleration_bound = jerk_bound / frequency
        for f, response in self._steady:
            turned = response * rect(1.0, f * t)
            y += turned.real
            u -= f * turned.imag
            size = abs(response) * f * f
            acceleration_bound += size
            jerk_bound += size * abs(f)
        for f, amplitude in self._resonant:
            displacement, rate = response_from_rest(oscillator, f, t)
            y += (amplitude * displacement).real
            u += (amplitude * rate).real
            ahead = t + self.horizon
            size = abs(amplitude) * (f + 2.0 * decay + frequency + ahead * f * f)
            acceleration_bound += size / frequency
            jerk_bound += size
        acceleration = -2.0 * decay * u - stiffness * y
        for f, amplitude in self._forcing:
            acceleration += (amplitude * rect(1.0, f * t)).real
        return Sample(y + self._offset, u, acceleration, acceleration_bound, jerk_bound)

    def reach(self) -> tuple[float, float]:
        """Bounds on |displacement| and |rate| for all time; infinite when forcing resonates."""
        if self._resonant:
            return inf, inf
        y0, u0 = self._free
        frequency = self._oscillator.frequency
        rate = hypot(u0, frequency * y0)
        displacement = rate / frequency + abs(self._offset)
        for f, response in self._steady:
            displacement += abs(response)
            rate += abs(f * response)
        return displacement, rate

    def _free_motion(self, t: float) -> tuple[float, float]:
        oscillator = self._oscillator
        cosine, sine = free_response(oscillator, t)
        y0, u0 = self._free
        decay = oscillator.decay
        return (
            y0 * (cosine + decay * sine) + u0 * sine,
            u0 * (cosine - decay * sine) - oscillator.stiffness * y0 * sine,
        )
