"""Work of full friction on a slider that slides, in closed form.

With s the direction of sliding and K the integral of n X', n = exp(i chi), the work is
W = s (F0 (X - X_0) + F1 Im K). Partial integration of both equations of motion gives K from the
states and phases at the ends: with r = m / (M + m) and T the response of the sliding resonator,
of stiffness k and decay d, to exp(-i q t),

    i q K = [n (X' + r T ((k - 2 i d q) Y' - i q k Y))] - integral of n (P + r q^2 T G)

where P are the forces on the pair per total mass, and G those on the resonator per its mass.
"""

from __future__ import annotations

from cmath import rect
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .device import System

SLOW = 1e-3
"""Share of the drive frequency below which a phasor is integrated as a series: its ends differ too
little."""

TERMS = 8
"""Terms of that series: over the longest leg, good to rounding."""

State = tuple[float, float, float]
"""Velocity of the slider [m/s], displacement [m] and rate [m/s] of the resonator."""


class SlideWork:
    """The coefficients for a system whose normal load swings, at a frequency q other than 0."""

    __slots__ = ("_by_drive", "_by_friction", "_displacement", "_q", "_rate", "_slow", "_w")

    def __init__(self, system: System) -> None:
        w, q, slip = system.drive_frequency, system.normal_frequency, system.slip
        response = 0j
        if system.is_full:
            response = system.mass_fraction * slip.transfer(q).conjugate()
        reaction = q * q * response
        base = system.base_acceleration - system.device.tangential_force / system.slider_mass
        steady = reaction / system.slider_mass - 1.0 / system.total_mass
        self._rate = response * complex(slip.stiffness, -2.0 * slip.decay * q)
        self._displacement = complex(0.0, -q * slip.stiffness) * response
        self._w, self._q = w, q
        # For each direction of sliding: by constant forces, and by the swing of friction.
        self._by_friction = {
            sign: (
                complex(0.0, -(system.load + sign * system.friction_preload) / q) * steady,
                sign * system.friction_amplitude * steady,
            )
            for sign in (1, -1)
        }
        self._by_drive, self._slow = [0j, 0j], list[tuple[int, complex, float]]()
        amplitudes = system.drive + reaction * base, system.drive.conjugate() + reaction * base
        for i, frequency in enumerate((q + w, q - w)):
            amplitude = complex(0.0, i - 0.5) * amplitudes[i]
            if abs(frequency) > SLOW * w:
                self._by_drive[i] = amplitude / complex(0.0, frequency)
            else:
                self._slow.append((i, amplitude, frequency))

    def over(
        self, sign: int, theta: float, chi: float, t: float, begin: State, end: State
    ) -> float:
        """Im K [m] in direction `sign`, from phases `theta` and `chi` [rad] on for `t` [s]."""
        q = self._q
        n0, n1 = rect(1.0, chi), rect(1.0, chi + q * t)
        d0, d1 = rect(1.0, theta), rect(1.0, theta + self._w * t)
        constant, swinging = self._by_friction[sign]
        own, (by_sum, by_difference) = -0.25 / q * swinging, self._by_drive
        v, y, u = begin
        first = v + self._rate * u + self._displacement * y - constant - own * n0 - by_sum * d0
        v, y, u = end
        last = v + self._rate * u + self._displacement * y - constant - own * n1 - by_sum * d1
        if by_difference:
            first -= by_difference * d0.conjugate()
            last -= by_difference * d1.conjugate()
        total = n1 * last - n0 * first - complex(0.0, 0.5 * t) * swinging
        for i, amplitude, frequency in self._slow:
            phasor = n0 * (d0.conjugate() if i else d0)
            growth = _growth(complex(0.0, frequency * t)) if frequency else 1.0
            total -= amplitude * phasor * growth * t
        return -total.real / q


def _growth(angle: complex) -> complex:
    """(exp(z) - 1) / z of a small angle."""
    total = 1.0 + 0j
    for k in range(TERMS, 1, -1):
        total = 1.0 + total * angle / k
    return total
