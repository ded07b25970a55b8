"""Mean friction over a turn of the drive, under fast vibration.

The slider moves with V - v_q cos(tau), so that it slides forward while tau is in (Theta, 2 pi -
Theta) with Theta = arccos(V / v_q). Under Coulomb friction the means are elementary integrals over
these two arcs (eqs 4 and 20). The response of a LuGre bristle to this motion is periodic, and
explicit in the path between the two reversals: what friction differs by from Coulomb's is a
quadrature. Soft bristles give the paper's slow manifold (17), hard ones Coulomb friction (5).
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise
from math import acos, cos, exp, expm1, hypot, pi, sin, tau

from .device import EPSILON, Device
from .vibrating_load import VibratingLoad

PANELS = (0.0, 0.05, 0.15, 0.35, 0.65, 1.0)
"""Panels of the quadrature over an arc; they crowd where sliding begins."""

NODES = 12
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

Means = tuple[float, float, float]
"""Means over a turn of tau of the friction per unit load, times 1, sin(n tau), cos(n tau)."""


@dataclass(frozen=True, slots=True)
class MeanFriction:
    """Friction under a fast motion of amplitude `fast` [m/s] at the drive `frequency` [rad/s].

    `stiffness` and `damping` of the bristles are sigma_0 and sigma_1, None for Coulomb friction.
    """

    coefficient: float
    stiffness: float | None
    damping: float
    fast: float
    frequency: float

    @property
    def is_expensive(self) -> bool:
        """Whether each mean costs a quadrature."""
        return self.stiffness is not None

    @property
    def drag(self) -> float:
        """Largest friction per unit load beyond mu; above mu, friction may rise with Theta."""
        return self.damping * self.fast if self.is_expensive else 0.0

    @property
    def grip(self) -> float:
        """Largest friction per unit load that resists the vibration about rest.

        A vibration far shorter than mu / sigma_0 only bends the bristle.
        """
        if self.stiffness is None:
            return self.coefficient
        bend = hypot(self.stiffness, self.frequency * self.damping)
        return min(self.coefficient, self.fast / self.frequency * bend)

    def turning(self, velocity: float) -> float:
        """Theta [rad] at a slow velocity [m/s]; 0 or pi where the slider never reverses."""
        if abs(velocity) >= self.fast:
            return 0.0 if velocity > 0.0 else pi
        return acos(velocity / self.fast)

    def mean(self, load: VibratingLoad, turning: float) -> float:
        """Mean friction [N] of one face when sliding turns forward at tau = `turning` [rad]."""
        if self.is_expensive and abs(load.wave_number) > MAX_WAVES:
            load = load.flattened()
        total = load.integral(turning, tau - turning) - load.integral(-turning, turning)
        total *= self.coefficient
        if self.is_expensive:
            bending = self._bending(turning, load.wave_number, load.kinks)
            total += sum(load.at(angle) * friction for angle, friction in bending)
        return total / tau

    def means(self, n: int, turning: float) -> Means:
        """The parts of that under a load N0 + dN sin(n tau + delta), n not 0.

        Per face it is N0 plain + dN (cos(delta) sine + sin(delta) cosine).
        """
        mu = self.coefficient
        waves = 0 if self.is_expensive and abs(n) > MAX_WAVES else n
        plain, sine = mu * (tau - 4.0 * turning), 0.0
        cosine = -4.0 * mu * sin(n * turning) / n if waves else 0.0
        if self.is_expensive:
            for angle, friction in self._bending(turning, float(waves), lambda begin, end: []):
                plain += friction
                if waves:
                    sine += friction * sin(n * angle)
                    cosine += friction * cos(n * angle)
        return plain / tau, sine / tau, cosine / tau

    def _bending(
        self, turning: float, wave_number: float, kinks: Callable[[float, float], list[float]]
    ) -> list[tuple[float, float]]:
        """Quadrature over both arcs of what the bristle still lacks of being fully bent.

        Angles [rad], and friction per unit load beyond Coulomb's times a weight. It serves
        integrands that vary as cos(wave_number tau), with kinks where `kinks` says.
        """
        mu, stiffness = self.coefficient, self.stiffness or 0.0
        reach = self.fast / self.frequency
        forward = _Arc(reach, 1, turning, tau - 2.0 * turning)
        backward = _Arc(reach, -1, -turning, 2.0 * turning)
        paths = forward.way(forward.length)[1], backward.way(backward.length)[1]
        begins = _periodic_friction(mu, *(-expm1(-stiffness * path / mu) for path in paths))
        nodes = []
        for arc, friction in zip((forward, backward), begins, strict=True):
            unbent = friction - arc.direction * mu
            if not abs(unbent) > EPSILON * mu:
                continue
            last = arc.bent_after(BENT * mu, stiffness)
            edges = [last * share for share in PANELS]
            inner = [kink - arc.begin for kink in kinks(arc.begin, arc.begin + last)]
            for low, high in _panels(edges, inner, wave_number):
                half = 0.5 * (high - low)
                for node, weight in _RULE:
                    ahead = low + half * (1.0 + node)
                    speed, path = arc.way(ahead)
                    lacking = unbent * exp(-stiffness * path / mu) * (1.0 - self.drag * speed / mu)
                    nodes.append((arc.begin + ahead, weight * half * lacking))
        return nodes


def mean_friction(device: Device, fast: float) -> MeanFriction:
    """Without vibration a bristle is always fully bent: friction is Coulomb's."""
    bends = device.friction_law == 1 and fast > 0.0
    stiffness = device.bristle_stiffness if bends else None
    mu, damping = device.friction_coefficient, device.bristle_damping
    return MeanFriction(mu, stiffness, damping, fast, device.drive_frequency)


@dataclass(slots=True)
class _Arc:
    """A part of the turn with one direction of sliding, from `begin` on for `length` [rad].

    The velocity is v_q (cos(begin) - cos(begin + ahead)); differences of nearly equal numbers are
    taken in closed form, for hard bristles see short paths. `reach` is v_q / w [m].
    """

    reach: float
    direction: int
    begin: float
    length: float

    def way(self, ahead: float) -> tuple[float, float]:
        """Speed over v_q, and path [m], `ahead` [rad] of where the arc begins."""
        sine, cosine = sin(self.begin), cos(self.begin)
        half_sine, half_cosine = sin(0.5 * ahead), cos(0.5 * ahead)
        turned = sine * half_cosine + cosine * half_sine
        beyond = _beyond_sine(ahead, 2.0 * half_sine * half_cosine)
        moved = cosine * beyond + 2.0 * sine * half_sine * half_sine
        return self.direction * 2.0 * half_sine * turned, self.direction * self.reach * moved

    def bent_after(self, full: float, stiffness: float) -> float:
        """How far ahead in the arc [rad] the path times `stiffness` [1/m] is `full`."""
        if stiffness * self.way(self.length)[1] <= full:
            return self.length
        low, high = 0.0, self.length
        for _ in range(60):
            middle = 0.5 * (low + high)
            if stiffness * self.way(middle)[1] < full:
                low = middle
            else:
                high = middle
        return high


def _beyond_sine(x: float, sine: float) -> float:
    """x - sin(x) for x >= 0, without cancellation."""
    if x > SERIES:
        return x - sine
    square, total = x * x, 1.0
    for divisor in _DIVISORS:
        total = 1.0 - square / divisor * total
    return x * square / 6.0 * total


def _panels(
    edges: list[float], kinks: list[float], wave_number: float
) -> list[tuple[float, float]]:
    """Panels between edges and kinks, none wider than WIDEST of the normal load."""
    begin, apart, panels = edges[0], [], []
    for kink in sorted(kinks):
        begin = max([begin, *(edge for edge in edges if edge <= kink)])
        if kink > begin + NARROW:
            apart.append(kink)
            begin = kink
    for low, high in pairwise(sorted(edges + apart)):
        pieces = 1 + int(abs(wave_number) * (high - low) / WIDEST)
        width = (high - low) / pieces
        panels += [(low + i * width, low + (i + 1) * width) for i in range(pieces)]
    return panels


def _periodic_friction(mu: float, forward: float, backward: float) -> tuple[float, float]:
    """sigma_0 z where the forward and the backward arc begin.

    By the share of its bend that a bristle makes up over each.
    """
    bent = forward + backward - forward * backward
    if bent == 0.0:
        return 0.0, 0.0
    at_forward = mu * (forward * (1.0 - backward) - backward) / bent
    return at_forward, at_forward + (mu - at_forward) * forward


def _gauss_legendre(count: int) -> tuple[tuple[float, float], ...]:
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


_RULE = _gauss_legendre(NODES)

# Motion asks for the means several times a step, and each costs a quadrature. They are smooth in
# Theta, with a layer at its ends that gets thinner for harder bristles: Chebyshev series on panels,
# halved until they hold. Turning Theta into pi - Theta mirrors the motion: half is kept.

TERMS = 9
"""Terms of each series."""

MAX_ERROR = 1e-8
"""Error of the means that a panel may have where it is checked, as a share of mu or of the largest
mean on the panel where that is larger."""

CHECKED = (-0.95, -0.85, -0.5, 0.35)
"""Places in a panel, which stands for [-1, 1], where a series is compared with the means."""

MAX_HALVINGS = 24
"""Halvings of a panel after which it is taken as it is, a fraction 6e-8 of the whole."""

MAX_PANELS = 32
"""Panels after which all are taken as they are: bounds the work. Harder bristles need more of them,
19 at kappa 1e17."""

MAX_WAVES_TABULATED = 8
"""Waves of the normal load over a turn up to which a table takes less time than it saves."""

_ANGLES = tuple(pi * (k + 0.5) / TERMS for k in range(TERMS))


@lru_cache(maxsize=4)
def tabulated_means(friction: MeanFriction, n: int) -> Callable[[float], Means]:
    """The means under n waves of the normal load over a turn, n not 0, to MAX_ERROR."""
    ends: list[float] = [0.0]
    panels: list[list[list[float]]] = []
    todo = [(0, 0.0, 0.5 * pi)]
    while todo:
        halvings, low, high = todo.pop()
        series, error = _series(friction, n, low, high)
        full = len(panels) + len(todo) + 1 >= MAX_PANELS
        if error <= MAX_ERROR or halvings == MAX_HALVINGS or full:
            ends.append(high)
            panels.append(series)
        else:
            middle = 0.5 * (low + high)
            todo += [(halvings + 1, middle, high), (halvings + 1, low, middle)]
    mirrored = -1.0 if n % 2 == 0 else 1.0

    def at(turning: float) -> Means:
        back = turning > 0.5 * pi
        angle = pi - turning if back else turning
        index = max(0, bisect_left(ends, angle, 0, len(panels)) - 1)
        low, high = ends[index], ends[index + 1]
        x = (2.0 * angle - low - high) / (high - low)
        plain, sine, cosine = (_chebyshev(c, x) for c in panels[index])
        return (-plain, mirrored * sine, mirrored * cosine) if back else (plain, sine, cosine)

    return at


def _series(
    friction: MeanFriction, n: int, low: float, high: float
) -> tuple[list[list[float]], float]:
    """Chebyshev series of the means on a panel, and their largest relative error where checked."""

    def means(x: float) -> Means:
        return friction.means(n, 0.5 * (low + high + (high - low) * x))

    at_nodes = [means(cos(angle)) for angle in _ANGLES]
    series = []
    for kind in range(3):
        values = [m[kind] for m in at_nodes]
        sums = [
            sum(v * cos(j * angle) for v, angle in zip(values, _ANGLES, strict=True))
            for j in range(TERMS)
        ]
        series.append([sums[0] / TERMS, *(2.0 * s / TERMS for s in sums[1:])])
    places, stiffness = list(CHECKED), friction.stiffness or 0.0
    if stiffness > 0.0:
        # Hard bristles bend where the backward path is about mu / sigma_0 long.
        length = friction.coefficient * friction.frequency / (stiffness * friction.fast)
        layer = length ** (1.0 / 3.0)
        places += [(2.0 * layer - low - high) / (high - low)] if low < layer < high else []
    error = 0.0
    for x in places:
        misses = (abs(_chebyshev(c, x) - m) for c, m in zip(series, means(x), strict=True))
        error = max(error, *misses)
    return series, error / max(friction.coefficient, *(abs(v) for m in at_nodes for v in m))


def _chebyshev(coefficients: list[float], x: float) -> float:
    """The value at x of a Chebyshev series, by Clenshaw's recurrence."""
    value = before = 0.0
    for c in reversed(coefficients[1:]):
        value, before = c + 2.0 * x * value - before, value
    return coefficients[0] + x * value - before
