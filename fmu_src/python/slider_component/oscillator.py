"""Closed forms of one damped oscillator, y'' + 2 decay y' + stiffness y = g(t).

Every form stays regular: at and around critical damping, without damping, and when the forcing
frequency meets the damped one, where the usual particular solution is singular.
"""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass

OSCILLATORY = 0.9
"""Damping ratio below which the complex eigenvalue is used; hyperbolic forms are used above."""

SLOW = 0.02
"""Share of the drive frequency below which an oscillator or a forcing counts as slow: its steady
response would be far larger than the response between two reversals."""

SOON = 0.3
"""Angle [rad] up to which power series in time are used."""

TERMS = 40

RESONANT = 0.02
"""Relative distance of forcing frequency and eigenvalue below which the particular solution,
which grows with the inverse of that distance, is replaced by the response from rest."""


@dataclass(frozen=True, slots=True)
class Oscillator:
    """Coefficients `decay` [1/s] and `stiffness` [1/s^2] of the oscillator."""

    decay: float
    stiffness: float

    @property
    def frequency(self) -> float:
        """Undamped angular frequency [rad/s]."""
        return math.sqrt(self.stiffness)

    @property
    def eigenvalue(self) -> complex | None:
        """The eigenvalue with positive imaginary part [1/s]; None from OSCILLATORY damping on."""
        if self.decay >= OSCILLATORY * self.frequency:
            return None
        return complex(-self.decay, math.sqrt(self.stiffness - self.decay * self.decay))


def transfer(oscillator: Oscillator, frequency: float) -> complex:
    """Steady response to exp(i frequency t), as a complex amplitude [s^2]."""
    return 1.0 / complex(
        oscillator.stiffness - frequency * frequency, 2.0 * oscillator.decay * frequency
    )


def resonates(oscillator: Oscillator, frequency: float) -> bool:
    """Whether the particular solution at this frequency [rad/s] is too large to be split off."""
    eigenvalue = oscillator.eigenvalue
    if eigenvalue is None:
        return False
    return abs(eigenvalue - complex(0.0, abs(frequency))) < RESONANT * abs(eigenvalue)


def free_response(oscillator: Oscillator, t: float) -> tuple[float, float]:
    """Decaying cosine C and sine S after `t` >= 0 [s] (S in seconds).

    From displacement y and velocity u the free motion is y (C + decay S) + u S, and its velocity
    is u (C - decay S) - stiffness y S.
    """
    decay, stiffness = oscillator.decay, oscillator.stiffness
    difference = stiffness - decay * decay
    if difference > 0.0:
        damped = math.sqrt(difference)
        envelope = math.exp(-decay * t)
        return envelope * math.cos(damped * t), envelope * math.sin(damped * t) / damped
    spread = math.sqrt(-difference)
    slow = math.exp(-stiffness / (decay + spread) * t) if decay > 0.0 else 1.0
    if spread * t < 1e-150:
        return slow, slow * t
    gap = -math.expm1(-2.0 * spread * t)
    return slow * (1.0 - 0.5 * gap), slow * gap / (2.0 * spread)


def complex_expm1(z: complex) -> complex:
    """exp(z) - 1 without cancellation for small z."""
    half = math.sin(0.5 * z.imag)
    growth = math.expm1(z.real)
    return complex(growth * math.cos(z.imag) - 2.0 * half * half, (growth + 1.0) * math.sin(z.imag))


def _divided_difference(a: complex, b: complex, t: float) -> complex:
    """(exp(a t) - exp(b t)) / (a - b), regular at a = b [s]."""
    if a == b:
        return t * cmath.exp(b * t)
    return cmath.exp(b * t) * complex_expm1((a - b) * t) / (a - b)


def response_from_rest(
    oscillator: Oscillator, frequency: float, t: float
) -> tuple[complex, complex]:
    """Response to exp(i frequency t) from rest: displacement [s^2] and velocity [s] at `t` [s].

    Regular at resonance, where it grows in proportion to t. Only for oscillatory damping.
    """
    eigenvalue = oscillator.eigenvalue
    if eigenvalue is None:
        raise ValueError(f"decay = {oscillator.decay!r}: must be that of oscillatory damping")
    forcing = complex(0.0, frequency)
    conjugate = eigenvalue.conjugate()
    near = _divided_difference(eigenvalue, forcing, t)
    far = _divided_difference(conjugate, forcing, t)
    width = complex(0.0, 2.0 * eigenvalue.imag)
    return (near - far) / width, (eigenvalue * near - conjugate * far) / width


def step_response(oscillator: Oscillator, t: float) -> tuple[float, float]:
    """Response to a unit step from rest: displacement [s^2] and velocity [s] at `t` [s].

    Without cancellation for soft oscillators, whose static displacement 1 / stiffness is far larger
    than the response.
    """
    decay, stiffness, frequency = oscillator.decay, oscillator.stiffness, oscillator.frequency
    cosine, sine = free_response(oscillator, t)
    if max(decay, frequency) * t < SOON:
        return slow_response_from_rest(oscillator, 0.0, t)[0].real, sine
    if decay > frequency:
        spread = math.sqrt(decay * decay - stiffness)
        slow, fast = stiffness / (decay + spread), decay + spread
        if spread > 0.1 * decay:
            return (math.expm1(-fast * t) / fast - math.expm1(-slow * t) / slow) / (
                fast - slow
            ), sine
    return (1.0 - cosine - decay * sine) / stiffness, sine


def slow_response_from_rest(
    oscillator: Oscillator, frequency: float, t: float
) -> tuple[complex, complex]:
    """Response to exp(i frequency t) from rest, for t far below all periods.

    Displacement [s^2] and velocity [s] at `t` [s] by their Taylor series in t.
    """
    decay, stiffness = oscillator.decay, oscillator.stiffness
    before, term = 0j, complex(0.5 * t * t)
    forcing = complex(t * t)
    displacement, velocity = term, 2.0 * term / t if t > 0.0 else 0j
    for n in range(3, TERMS):
        forcing *= complex(0.0, frequency * t) / (n - 2)
        following = (forcing - 2.0 * decay * t * (n - 1) * term - stiffness * t * t * before) / (
            n * (n - 1)
        )
        before, term = term, following
        displacement += term
        velocity += n * term / t if t > 0.0 else 0j
    return displacement, velocity


def integral(frequency: float, t: float) -> complex:
    """Integral of exp(i frequency s) over s from 0 to t [s], regular at frequency 0."""
    half = 0.5 * frequency * t
    sinc = math.sin(half) / half if half != 0.0 else 1.0
    return t * sinc * cmath.rect(1.0, half)


def double_integral(frequency: float, t: float) -> complex:
    """Integral of (t - s) exp(i frequency s) over s from 0 to t [s^2], regular at frequency 0."""
    angle = frequency * t
    if abs(angle) > 0.5:
        return (complex_expm1(complex(0.0, angle)) - complex(0.0, angle)) / -(frequency * frequency)
    term = complex(0.5)
    total = term
    for n in range(3, 16):
        term *= complex(0.0, angle / n)
        total += term
    return t * t * total
