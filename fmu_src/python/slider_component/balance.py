"""Where mean friction and load balance: the angle Theta at which sliding turns forward.

The result is that of plain bisection. Chandrupatla's method first brackets the balance: inverse
quadratic interpolation where its criterion accepts it, bisection otherwise. Signs that this bracket
implies are then not evaluated. On a flat balance (even ratios, with flight while sliding turns) the
result is the end of the highest velocity. On a weak one it is uncertain by rounding.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import inf
from typing import NamedTuple

BISECTIONS = 52
"""Halvings of [0, pi] in which the angle of balance is found."""

SORTING = 4
"""The first halvings, which select one of several balances."""

EDGE_HALVINGS = 40
"""Halvings that locate the edge of a flat balance."""

FLAT = 3e-3
"""Width [rad] of a balance from which on it is flat, not just uncertain by rounding."""

MAX_EVALUATIONS = 100

CLOSE = 2e-15
"""Width [rad] of the bracket at which Chandrupatla's method ends."""

STEEP = 1e-12
"""Width [rad] of a bracket below which any angle in it serves as the balance."""


@dataclass(frozen=True, slots=True)
class Balance:
    """The `excess` of friction and load [N] over the angle Theta [rad], known to `noise` [N].

    `excess_near` is the same by a closed form, if there is one, which takes less time. Where
    friction `rises` with the angle there may be several balances.
    """

    excess: Callable[[float], float]
    excess_near: Callable[[float], float]
    noise: float
    rises: bool


class Point(NamedTuple):
    """The excess [N] at an angle [rad]."""

    turning: float
    excess: float


class Bracket:
    """Up to `positive` the excess is above 0 beyond rounding, from `negative` on it is below 0.

    In between it is 0 within rounding; `root` is the best estimate. All in rad.
    """

    __slots__ = ("_noise", "negative", "positive", "root")

    def __init__(self, low: Point, high: Point, noise: float) -> None:
        self.positive, self.negative, self.root = low.turning, high.turning, 0.0
        self._noise = noise

    def narrow(self, point: Point) -> bool:
        """Narrow the bracket by a point; return whether the sign of its excess is certain."""
        if not abs(point.excess) > self._noise:
            return False
        if point.excess > 0.0:
            self.positive = max(self.positive, point.turning)
        else:
            self.negative = min(self.negative, point.turning)
        return True


def balanced_turning(balance: Balance, low: Point, halfway: Point, high: Point) -> float:
    """Angle at which friction and load balance [rad], from the excess at 0, pi / 2 and pi."""
    done = SORTING if balance.rises else 0
    for _ in range(done):
        low, high = (halfway, high) if halfway.excess > 0.0 else (low, halfway)
        middle = 0.5 * (low.turning + high.turning)
        halfway = Point(middle, balance.excess(middle))
    bracket = Bracket(low, high, balance.noise)
    if low.excess > 0.0 >= high.excess:
        bracket = _closed_in(balance, low, halfway, high)
    elif not balance.rises:
        return high.turning if low.excess > 0.0 else low.turning
    if bracket.positive > bracket.negative:
        bracket.positive, bracket.negative = low.turning, high.turning
    if bracket.negative - bracket.positive < STEEP:
        return bracket.root
    flat = _flat_from(balance, bracket)
    if flat is not None:
        return flat
    first, last = low.turning, high.turning
    for _ in range(done, BISECTIONS):
        turning = 0.5 * (first + last)
        above = turning <= bracket.positive
        if not above and turning < bracket.negative:
            above = balance.excess(turning) > 0.0
        first, last = (turning, last) if above else (first, turning)
    return 0.5 * (first + last)


def _flat_from(balance: Balance, bracket: Bracket) -> float | None:
    """The lower end of the range in which friction and load balance; None if narrower than FLAT."""
    if abs(balance.excess(bracket.root)) > balance.noise:
        return None
    begin = _edge(balance, bracket.positive, bracket.root, 1.0)
    end = _edge(balance, bracket.negative, bracket.root, -1.0)
    return begin if end - begin > FLAT else None


def _edge(balance: Balance, outside: float, inside: float, sign: float) -> float:
    """The edge of a flat balance, between an angle `outside` and one `inside` [rad]."""
    for _ in range(EDGE_HALVINGS):
        middle = 0.5 * (outside + inside)
        if sign * balance.excess(middle) > balance.noise:
            outside = middle
        else:
            inside = middle
    return inside


def _closed_in(balance: Balance, low: Point, following: Point, high: Point) -> Bracket:
    """The bracket between `low`, where the excess is above 0, and `high`, where it is not."""
    newest, other = high, low
    bracket = Bracket(low, high, balance.noise)
    for _ in range(MAX_EVALUATIONS):
        before = newest
        if (following.excess > 0.0) != (newest.excess > 0.0):
            before, other = other, newest
        newest = following
        width = other.turning - newest.turning
        min_share = CLOSE / abs(width) if width else inf
        if not bracket.narrow(newest) or not min_share < 0.5:
            break
        share = _share_of_the_way(newest, other, before)
        share = min(max(share, min_share), 1.0 - min_share)
        turning = newest.turning + share * width
        following = Point(turning, balance.excess_near(turning))
    nearest = newest if abs(newest.excess) < abs(other.excess) else other
    bracket.root = nearest.turning
    rise = other.excess - newest.excess
    flatness = abs((other.turning - newest.turning) / rise) if rise else inf
    aside = CLOSE + 1.5 * balance.noise * flatness
    for turning in (bracket.root - aside, bracket.root + aside):
        if bracket.positive < turning < bracket.root or bracket.root < turning < bracket.negative:
            bracket.narrow(Point(turning, balance.excess_near(turning)))
    return bracket


def _share_of_the_way(a: Point, b: Point, c: Point) -> float:
    """Share of the way from the newest point `a` to the opposite one `b` at which to evaluate next.

    `c` is the point before `a`.
    """
    try:
        xi = (a.turning - b.turning) / (c.turning - b.turning)
        phi = (a.excess - b.excess) / (c.excess - b.excess)
        share = a.excess / (b.excess - a.excess) * c.excess / (b.excess - c.excess) + (
            c.turning - a.turning
        ) / (b.turning - a.turning) * a.excess / (c.excess - a.excess) * b.excess / (
            c.excess - b.excess
        )
    except ZeroDivisionError:
        return 0.5
    trusted = phi * phi < xi and (1.0 - phi) * (1.0 - phi) < 1.0 - xi
    return share if trusted else 0.5
