"""Averaged LuGre friction under fast vibration, uniform in the bristle stiffness.

Over one turn of tau the bristle response to the fast motion is periodic, and explicit in the path
between the two reversals, so the mean friction is a quadrature: soft bristles give the paper's slow
manifold (17), hard ones Coulomb friction (5).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import cache
from itertools import pairwise
from math import cos, exp, expm1, hypot, pi, sin, tau

from .averaged_friction import AveragedFriction, FastMotion, FrictionMeans
from .bristle import Bristle
from .motion import EPSILON
from .vibrating_load import VibratingLoad

NODES = 12
PANELS = (0.0, 0.05, 0.15, 0.35, 0.65, 1.0)
"""Panels of the quadrature over an arc; they crowd where sliding begins."""

WIDEST = 6.0
"""Widest panel as an angle [rad] of the normal load: there 12 nodes follow its sine to rounding."""

NARROW = 1e-12
"""Narrowest part [rad] that is kept apart: what is narrower adds no more than rounding."""

BENT = 40.0
"""Path in units of mu / sigma_0 after which a bristle is fully bent to rounding."""

MAX_WAVES = 1000
"""Waves of the normal load over a turn of the drive beyond which only its mean counts: what they
add to the mean friction falls with their number, to less than 1e-3 of full friction."""


SERIES = 1.0
"""Angle [rad] up to which x - sin(x) is summed up as a series."""

_DIVISORS = tuple(2 * k * (2 * k + 1) for k in range(8, 1, -1))


Bending = tuple[float, float]
"""An angle [rad], and friction per unit load beyond Coulomb's, times a weight of the quadrature."""


def mean_friction(bristle: Bristle, fast: FastMotion, load: VibratingLoad, turning: float) -> float:
    """See AveragedFriction."""
    if abs(load.wave_number) > MAX_WAVES:
        load = load.flattened()
    coulomb = load.integral(turning, tau - turning) - load.integral(-turning, turning)
    nodes = _bending(bristle, fast, turning, load.wave_number, load.kinks)
    bent = sum(load.at(angle) * friction for angle, friction in nodes)
    return (bristle.coefficient * coulomb + bent) / tau


def friction_means(bristle: Bristle, fast: FastMotion, n: int, turning: float) -> FrictionMeans:
    """See AveragedFriction."""
    mu = bristle.coefficient
    plain, sine = mu * (tau - 4.0 * turning), 0.0
    waves = n if abs(n) <= MAX_WAVES else 0
    cosine = -4.0 * mu * sin(n * turning) / n if waves else 0.0
    for angle, friction in _bending(bristle, fast, turning, float(waves), _no_kinks):
        plain += friction
        if waves == 0:
            continue
        sine += friction * sin(n * angle)
        cosine += friction * cos(n * angle)
    return FrictionMeans(plain / tau, sine / tau, cosine / tau)


def grip(bristle: Bristle, amplitude: float, frequency: float) -> float:
    """See AveragedFriction. A vibration far shorter than mu / sigma_0 only bends the bristle."""
    return min(
        bristle.coefficient, amplitude * hypot(bristle.stiffness, frequency * bristle.damping)
    )


def drag(bristle: Bristle, fast_velocity: float) -> float:
    """See AveragedFriction."""
    return bristle.damping * fast_velocity


def _no_kinks(begin: float, end: float) -> list[float]:
    return []


class Arc:
    """A part of the turn with one direction of sliding, from `begin` on for `length` [rad].

    The velocity is v_q (cos(begin) - cos(begin + ahead)); differences of nearly equal numbers are
    taken in closed form, for hard bristles see short paths.
    """

    __slots__ = ("_cosine", "_reach", "_sine", "begin", "direction", "length")

    def __init__(self, fast: FastMotion, direction: int, begin: float, length: float) -> None:
        self.direction, self.begin, self.length = direction, begin, length
        self._cosine, self._sine = cos(begin), sin(begin)
        self._reach = fast.velocity / fast.frequency

    def way(self, ahead: float) -> tuple[float, float]:
        """Speed over v_q, and path [m], `ahead` [rad] of where the arc begins."""
        half_sine, half_cosine = sin(0.5 * ahead), cos(0.5 * ahead)
        turned = self._sine * half_cosine + self._cosine * half_sine
        beyond = _beyond_sine(ahead, 2.0 * half_sine * half_cosine)
        moved = self._cosine * beyond + 2.0 * self._sine * half_sine * half_sine
        return (
            self.direction * 2.0 * half_sine * turned,
            self.direction * self._reach * moved,
        )

    def path(self, ahead: float) -> float:
        """Path [m], `ahead` [rad] of where the arc begins."""
        return self.way(ahead)[1]


def _beyond_sine(x: float, sine: float) -> float:
    """x - sin(x) for x >= 0, without cancellation."""
    if x > SERIES:
        return x - sine
    square, total = x * x, 1.0
    for divisor in _DIVISORS:
        total = 1.0 - square / divisor * total
    return x * square / 6.0 * total


def _bending(
    bristle: Bristle,
    fast: FastMotion,
    turning: float,
    wave_number: float,
    kinks: Callable[[float, float], list[float]],
) -> list[Bending]:
    """Quadrature over both arcs of what the bristle still lacks of being fully bent.

    It serves integrands that vary as cos(wave_number tau), with kinks where `kinks` says.
    """
    mu = bristle.coefficient
    forward = Arc(fast, 1, turning, tau - 2.0 * turning)
    backward = Arc(fast, -1, -turning, 2.0 * turning)
    start = _periodic_friction(
        bristle, forward.path(forward.length), backward.path(backward.length)
    )
    stiffness, drag = bristle.stiffness, bristle.damping * fast.velocity
    rule = gauss_legendre(NODES)
    nodes = []
    for arc in (forward, backward):
        unbent = start[arc.direction] - arc.direction * mu
        if not abs(unbent) > EPSILON * mu:
            continue
        last = _bent_at(bristle, arc)
        edges = [last * share for share in PANELS]
        inner = [kink - arc.begin for kink in kinks(arc.begin, arc.begin + last)]
        begin, way = arc.begin, arc.way
        for low, high in _panels(edges, inner, wave_number):
            half = 0.5 * (high - low)
            for node, weight in rule:
                ahead = low + half * (1.0 + node)
                speed, path = way(ahead)
                fade = exp(-stiffness * path / mu)
                friction = unbent * fade * (1.0 - drag * speed / mu)
                nodes.append((begin + ahead, weight * half * friction))
    return nodes


def _panels(
    edges: list[float], kinks: list[float], wave_number: float
) -> Iterator[tuple[float, float]]:
    """Panels between edges and kinks, none wider than WIDEST of the normal load."""
    begin, apart = edges[0], []
    for kink in sorted(kinks):
        begin = max([begin, *(edge for edge in edges if edge <= kink)])
        if kink > begin + NARROW:
            apart.append(kink)
            begin = kink
    for low, high in pairwise(sorted(edges + apart)):
        pieces = 1 + int(abs(wave_number) * (high - low) / WIDEST)
        width = (high - low) / pieces
        for piece in range(pieces):
            yield low + piece * width, low + (piece + 1) * width


def _periodic_friction(bristle: Bristle, forward: float, backward: float) -> dict[int, float]:
    """sigma_0 z where the forward and the backward arc begin, for these paths [m]."""
    mu = bristle.coefficient
    bent_forward = -expm1(-bristle.stiffness * forward / mu)
    bent_backward = -expm1(-bristle.stiffness * backward / mu)
    bent = bent_forward + bent_backward - bent_forward * bent_backward
    if bent == 0.0:
        return {1: 0.0, -1: 0.0}
    at_forward = mu * (bent_forward * (1.0 - bent_backward) - bent_backward) / bent
    return {1: at_forward, -1: at_forward + (mu - at_forward) * bent_forward}


def _bent_at(bristle: Bristle, arc: Arc) -> float:
    """How far ahead in the arc [rad] the bristle is fully bent."""
    full = BENT * bristle.coefficient
    if bristle.stiffness * arc.path(arc.length) <= full:
        return arc.length
    low, high = 0.0, arc.length
    for _ in range(60):
        middle = 0.5 * (low + high)
        if bristle.stiffness * arc.path(middle) < full:
            low = middle
        else:
            high = middle
    return high


@cache
def gauss_legendre(count: int) -> tuple[tuple[float, float], ...]:
    """Nodes and weights on [-1, 1], by Newton's method on the Legendre polynomial."""
    rule = []
    for i in range(count):
        x = cos(pi * (i + 0.75) / (count + 0.5))
        for _ in range(8):
            before, value = 1.0, x
            for k in range(2, count + 1):
                before, value = value, ((2 * k - 1) * x * value - (k - 1) * before) / k
            slope = count * (x * value - before) / (x * x - 1.0)
            x -= value / slope
        rule.append((x, 2.0 / ((1.0 - x * x) * slope * slope)))
    return tuple(rule)


AVERAGED_LUGRE = AveragedFriction(True, grip, drag, mean_friction, friction_means)
