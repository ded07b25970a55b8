"""Orbits on a panel of slow velocities, as polynomials."""

from __future__ import annotations

from dataclasses import dataclass
from math import acos, pi

from .contact import BACKWARD, FORWARD
from .orbit_point import OrbitPoint, Quantities

BASE_PANELS = 4
"""Panels in chi that are halved."""

MAX_DEPTH = 6
"""Most halvings."""

MAX_DEPTH_MISSING = 2
"""Most halvings of a panel in which an orbit is missing."""

NEGLIGIBLE_TERMS = 1e-13
"""Sum of the last coefficients up to which they are rounding, over the largest."""


@dataclass(frozen=True, slots=True)
class OrbitPanel:
    """Chebyshev coefficients over the panel `index` of 2^depth in which each base panel is halved.

    Of each quantity only those that are not rounding, an even number. `coefficients` is None where
    an orbit is missing; `holds` is false where the panel has to be halved. `maps` is how often a
    period was mapped for it.
    """

    depth: int
    index: int
    holds: bool
    coefficients: tuple[tuple[float, ...], ...] | None
    maps: int

    @property
    def direction(self) -> int:
        """Direction of the section."""
        return direction_of_panel(self.depth, self.index)

    def at(self, quantity: int, place: float) -> float:
        """The quantity at `place` = chi / pi BASE_PANELS; only for a panel with coefficients.

        By Clenshaw's recurrences for the even and the odd polynomials, T_2j(x) = T_j(y) and
        T_2j+1(x) = x (U_j(y) - U_j-1(y)) with y = T_2(x).
        """
        assert self.coefficients is not None
        c = self.coefficients[quantity]
        x = 2.0 * (place * (1 << self.depth) - self.index) - 1.0
        y = 2.0 * x * x - 1.0
        even = even_behind = odd = odd_behind = 0.0
        for k in range(len(c) - 2, 0, -2):
            even, even_behind = 2.0 * y * even + (c[k] - even_behind), even
            odd, odd_behind = 2.0 * y * odd + (c[k + 1] - odd_behind), odd
        last_odd = 2.0 * y * odd + (c[1] - odd_behind)
        return y * even + (c[0] - even_behind) + x * (last_odd - odd)

    def point(self, place: float) -> OrbitPoint:
        """All quantities there."""
        of = Quantities(*(self.at(q, place) for q in range(len(Quantities._fields))))
        return OrbitPoint(of, self.direction)


def direction_of_panel(depth: int, index: int) -> int:
    """Direction of the section of orbits on a panel."""
    return FORWARD if index >> depth < BASE_PANELS // 2 else BACKWARD


def place_between(middle: float, reach: float, velocity: float) -> float:
    """Place of a velocity among the base panels, from 0 on; negative beyond grazing."""
    share = (velocity - middle) / reach
    return acos(share) / pi * BASE_PANELS if abs(share) < 1.0 else -1.0


def index_at(place: float, depth: int) -> int:
    """Index of the panel of a depth at a place."""
    return min(int(place * (1 << depth)), (BASE_PANELS << depth) - 1)


def trimmed(coefficients: list[float]) -> tuple[float, ...]:
    """The first coefficients, an even number, without those that are rounding."""
    largest, rest, terms = max(map(abs, coefficients)), 0.0, len(coefficients)
    while terms > 1 and rest <= NEGLIGIBLE_TERMS * largest:
        terms -= 1
        rest += abs(coefficients[terms])
    terms += rest > NEGLIGIBLE_TERMS * largest
    return (*coefficients[:terms], *[0.0] * (terms % 2))
