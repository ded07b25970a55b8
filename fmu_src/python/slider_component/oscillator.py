"""A damped oscillator y'' + 2 decay y' + stiffness y = g(t), in forms that stay regular everywhere.

All responses are divided differences of exp(z t) over the eigenvalues and the frequencies of the
forcing: from rest, exp(i f t) moves the oscillator by exp[l1, l2, i f](t). Where nodes meet (at
critical damping, at resonance without damping, for constant forcing of a soft oscillator) a divided
difference becomes a derivative, and nothing is singular.
"""

from __future__ import annotations

from cmath import exp, rect
from cmath import sqrt as complex_sqrt
from dataclasses import dataclass
from functools import cached_property
from math import cos, expm1, hypot, sin, sqrt

OSCILLATORY = 0.9
"""Damping ratio below which an oscillation sets the pace of a motion and may be split off."""

CLOSE = 0.5
"""Spread of the nodes times t up to which differences of exponentials would lose digits."""

TERMS = 14
"""Terms of a series up to that spread, which then holds to rounding."""

AHEAD = 5.0
"""Horizon of the bounds below, as an angle [rad] of the highest frequency: longer than most
slides."""


@dataclass(frozen=True)
class Oscillator:
    """Coefficients `decay` [1/s] and `stiffness` [1/s^2] of the oscillator."""

    decay: float
    stiffness: float

    @property
    def frequency(self) -> float:
        """Undamped angular frequency [rad/s]."""
        return sqrt(self.stiffness)

    @property
    def is_oscillatory(self) -> bool:
        """Whether the damping ratio is below OSCILLATORY."""
        return self.decay < OSCILLATORY * self.frequency

    @cached_property
    def eigenvalues(self) -> tuple[complex, complex]:
        """Both eigenvalues [1/s]: conjugate with the upper one first, or the slow one first."""
        root = complex_sqrt(self.decay * self.decay - self.stiffness)
        fast = -self.decay - root
        return (self.stiffness / fast if fast else 0j), fast

    def free(self, t: float) -> tuple[tuple[float, float], tuple[float, float]]:
        """Displacement and rate after `t` >= 0 [s] without forcing: by the initial ones."""
        slow, fast = self.eigenvalues
        sine = divided(slow, fast, t).real
        return (
            ((exp(slow * t) - slow * sine).real, sine),
            (-self.stiffness * sine, (exp(fast * t) + slow * sine).real),
        )

    def transfer(self, frequency: float) -> complex:
        """Steady response to exp(i frequency t), as a complex amplitude [s^2]."""
        stiffness, damping = self.stiffness, 2.0 * self.decay * frequency
        return 1.0 / complex(stiffness - frequency * frequency, damping)


def complex_expm1(z: complex) -> complex:
    """exp(z) - 1 without cancellation for small z."""
    half, growth = sin(0.5 * z.imag), expm1(z.real)
    real = growth * cos(z.imag) - 2.0 * half * half
    return complex(real, (growth + 1.0) * sin(z.imag))


def divided(a: complex, b: complex, t: float) -> complex:
    """(exp(a t) - exp(b t)) / (a - b), regular at a = b [s]."""
    if a == b:
        return t * exp(b * t)
    if abs(a - b) * t > CLOSE:
        return (exp(a * t) - exp(b * t)) / (a - b)
    return exp(b * t) * complex_expm1((a - b) * t) / (a - b)


def divided_twice(a: complex, b: complex, c: complex, t: float) -> complex:
    """The divided difference of exp(z t) over three nodes, regular where they meet [s^2]."""
    # Nodes far apart lose the fewest digits: let them be the first and the last.
    near, far, apart = abs(a - b), abs(b - c), abs(a - c)
    if near > apart and near >= far:
        b, c, apart = c, b, near
    elif far > apart:
        a, b, apart = b, a, far
    if apart * t > CLOSE:
        return (divided(a, b, t) - divided(b, c, t)) / (a - c)
    mean = (a + b + c) / 3.0
    x, y, z = (a - mean) * t, (b - mean) * t, (c - mean) * t
    # Complete homogeneous polynomials of one, two and three of these, over factorials.
    one = two = three = 1.0 + 0j
    total, factor = 0.5 + 0j, 0.5
    for k in range(1, TERMS):
        one *= x
        two = y * two + one
        three = z * three + two
        factor /= k + 2
        total += factor * three
    return t * t * exp(mean * t) * total


class ForcedMotion:
    """Motion of an oscillator under the sum of Re(amplitude exp(i frequency t)).

    `forcing` lists (frequency [rad/s], complex amplitude [m/s^2]), at frequency 0 a constant; the
    motion starts at displacement `y0` [m] and rate `u0` [m/s]. `horizon` [s] is how far ahead its
    bounds hold.
    """

    __slots__ = ("_bound", "_forcing", "_oscillator", "_start", "horizon", "reach")

    def __init__(
        self,
        oscillator: Oscillator,
        forcing: tuple[tuple[float, complex], ...],
        y0: float,
        u0: float,
    ) -> None:
        self._oscillator = oscillator
        self._forcing = tuple((f, a) for f, a in forcing if a)
        self._start = (y0, u0)
        highest = max([oscillator.frequency, *(abs(f) for f, _ in forcing)])
        self.horizon = AHEAD / highest
        self._bound = self.horizon * sum(abs(a) * f * f for f, a in self._forcing)
        pushed = self.horizon * sum(abs(a) for _, a in self._forcing)
        self.reach = hypot(u0, oscillator.frequency * y0) + pushed
        """Scale of the rate [m/s]."""

    def at(self, t: float) -> tuple[float, float]:
        """Displacement [m] and rate [m/s] after `t` >= 0 [s]."""
        slow, fast = self._oscillator.eigenvalues
        y0, u0 = self._start
        (cosine, sine), (falling, slope) = self._oscillator.free(t)
        y, u = cosine * y0 + sine * u0, falling * y0 + slope * u0
        for f, amplitude in self._forcing:
            forcing = complex(0.0, f)
            moved = divided_twice(slow, fast, forcing, t)
            # By Leibniz' rule, with the smaller node: it cancels less.
            if abs(f) <= abs(slow):
                rate = forcing * moved + sine
            else:
                rate = slow * moved + divided(fast, forcing, t)
            y += (amplitude * moved).real
            u += (amplitude * rate).real
        return y, u

    def ahead(self, t: float) -> tuple[float, float, float, float, float, float]:
        """y, y' and y'' after `t` [s], and bounds on |y'|, |y''| and |y'''| up to the horizon.

        y'' is a motion of the same oscillator, whose energy grows by its forcing alone: that bounds
        the two higher ones; a mean value bounds the first.
        """
        oscillator = self._oscillator
        y, u = self.at(t)
        acceleration = -2.0 * oscillator.decay * u - oscillator.stiffness * y
        change = 0.0
        for f, amplitude in self._forcing:
            turned = amplitude * rect(1.0, f * t)
            acceleration += turned.real
            change -= f * turned.imag
        jerk = change - 2.0 * oscillator.decay * acceleration - oscillator.stiffness * u
        jerk_bound = hypot(jerk, oscillator.frequency * acceleration) + self._bound
        acceleration_bound = min(
            jerk_bound / oscillator.frequency, abs(acceleration) + self.horizon * jerk_bound
        )
        rate_bound = abs(u) + self.horizon * acceleration_bound
        return y, u, acceleration, rate_bound, acceleration_bound, jerk_bound
