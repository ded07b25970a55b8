"""A damped oscillator y'' + 2 decay y' + stiffness y = g(t)."""

from cmath import sqrt as complex_sqrt
from dataclasses import dataclass
from functools import cached_property
from math import sqrt

APART = 0.87
"""Distance of the eigenvalues, over the undamped frequency, from which on they are well apart: at
damping ratios below 0.9 and above 1.1."""

DISTINCT = 1e-8
"""Half the distance of two equal eigenvalues, over each: what it changes is rounding, squared."""

SLOW = 0.02
"""Share of the drive frequency below which an oscillator or a forcing counts as slow, and relative
distance of forcing frequency and eigenvalue in resonance: there the steady response would be far
larger than the response between two reversals."""


@dataclass(frozen=True)
class Oscillator:
    """Coefficients `decay` [1/s] and `stiffness` [1/s^2] of the oscillator."""

    decay: float
    stiffness: float

    @property
    def frequency(self) -> float:
        """Undamped angular frequency [rad/s]."""
        return sqrt(self.stiffness)

    @cached_property
    def eigenvalues(self) -> tuple[complex, complex]:
        """Both eigenvalues [1/s]: conjugate with the upper one first, or the slow one first.

        Two that are equal count as `DISTINCT`: free motion is a sum of two exponentials.
        """
        root = complex_sqrt(self.decay * self.decay - self.stiffness) or DISTINCT * self.decay
        fast = -self.decay - root
        return (self.stiffness / fast if fast else 0j), fast

    def splits(self, *frequencies: float) -> bool:
        """Whether free motion and steady responses at `frequencies` [rad/s] lose few digits."""
        slow, fast = self.eigenvalues
        if self.frequency < SLOW * max(map(abs, frequencies)):
            return False
        resonant = (abs(slow - complex(0.0, abs(f))) < SLOW * abs(slow) for f in frequencies)
        return abs(slow - fast) > APART * self.frequency and not any(resonant)

    def transfer(self, frequency: float) -> complex:
        """Steady response to exp(i frequency t), as a complex amplitude [s^2]."""
        damping = 2.0 * self.decay * frequency
        return 1.0 / complex(self.stiffness - frequency * frequency, damping)

    def free(self, y: float, u: float) -> list[tuple[complex, complex]]:
        """Rates z and amplitudes a of free motion, the sum of Re(a exp(z t)).

        From displacement `y` and rate `u` on.
        """
        slow, fast = self.eigenvalues
        if slow.imag:
            return [(slow, complex(y, (slow.real * y - u) / slow.imag))]
        of_slow = (u - fast * y) / (slow - fast)
        return [(slow, of_slow), (fast, y - of_slow)]
