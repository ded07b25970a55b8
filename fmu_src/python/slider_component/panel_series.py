"""A polynomial on a panel, which stands for [-1, 1], in Newton's form: a value adds a term.

The nodes are Leja's: each is where a polynomial through those before errs most, so what it misses
there is about its largest error. The first of them pass the panel from one end to the other.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from math import prod

ORBIT_NODES = 20
"""Most nodes of a panel."""

PASSING_NODES = 5
"""Nodes that pass it."""

NODE = (
    *(0.995, 0.6, 0.0, -0.6, -0.995, -0.8424, 0.8515, 0.2837, -0.3352, 0.9424),
    *(-0.9418, 0.4464, -0.7224, -0.1655, 0.7477, -0.4747, 0.9765, -0.9764, 0.1489, 0.6773),
)
"""Places in the panel; they begin next to 1."""


@dataclass(slots=True)
class PanelSeries:
    """The terms for the values at the first nodes."""

    terms: list[float] = field(default_factory=list)

    def at(self, x: float) -> float:
        """The value at a place."""
        total = 0.0
        for k in range(len(self.terms) - 1, -1, -1):
            total = total * (x - NODE[k]) + self.terms[k]
        return total

    def add(self, value: float) -> float:
        """Add the value at the next node; gives by how much the polynomial before missed it."""
        x = NODE[len(self.terms)]
        missed = value - self.at(x)
        self.terms.append(missed / prod(x - NODE[k] for k in range(len(self.terms))))
        return missed

    def chebyshev(self, side: int) -> list[float]:
        """The coefficients of its Chebyshev polynomials in `side` x, `side` 1 or -1."""
        total: list[float] = []
        for k in range(len(self.terms) - 1, -1, -1):
            # x T_0 = T_1, and x T_j = (T_(j+1) + T_(j-1)) / 2.
            following = [0.0] * (len(total) + 1)
            for j, coefficient in enumerate(total):
                following[j + 1] += 0.5 * coefficient if j else coefficient
                following[j] -= NODE[k] * coefficient
                if j:
                    following[j - 1] += 0.5 * coefficient
            following[0] += self.terms[k]
            total = following
        return [side**k * coefficient for k, coefficient in enumerate(total)]
