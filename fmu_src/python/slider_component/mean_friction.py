"""Mean friction over a turn of the drive, under fast vibration.

The slider moves with V - v_q cos(tau), so that it slides forward while tau is in (Theta, 2 pi -
Theta) with Theta = arccos(V / v_q). Under Coulomb friction the means are elementary integrals over
these two arcs (eqs 4 and 20). The response of a LuGre bristle to this motion is periodic, and
explicit in the path between the two reversals: what friction differs by from Coulomb's is a
quadrature. Soft bristles give the paper's slow manifold (17), hard ones Coulomb friction (5).
"""

from itertools import pairwise
from math import acos, cos, exp, expm1, inf, pi, sin, tau
from typing import NamedTuple

from .contact import VibratingLoad
from .device import EPSILON, Device

NODES = 44
"""Nodes of the quadrature: they follow exp(-BENT x^2) over an arc to 1e-13."""

WIDEST = 18.0
"""Widest panel as an angle [rad] of the normal load: there the nodes follow its sine to 1e-13."""

BENT = 37.0
"""Path in units of mu / sigma_0 after which a bristle is fully bent to rounding."""

MAX_WAVES = 1000
"""Waves of the normal load over a turn of the drive beyond which only its mean counts: what they
add to mean friction and power falls with their number, to less than 1e-3 of full friction."""

Node = tuple[float, float, float]
"""Weight with the load [N rad], velocity over v_q, and friction per unit load or path [m]."""


class MeanFriction:
    """Friction of all `faces` of a device under a fast motion of amplitude `fast` [m/s].

    It has a friction `coefficient`. Where a bristle `bends`, each mean costs a quadrature: one of
    some `stiffness` sigma_0 [1/m] and `damping` sigma_1 [s/m]. Its `drag` is the largest friction
    per unit load beyond mu: above mu, friction may rise with Theta. A mean takes a load of up to
    `max_waves`, the power one of up to MAX_WAVES.
    """

    def __init__(self, device: Device, fast: float) -> None:
        """Without vibration a bristle is always fully bent: friction is Coulomb's."""
        self.fast, self._reach = fast, fast / device.drive_frequency
        self.faces, self.coefficient = device.friction_faces, device.friction_coefficient
        self.bends = device.friction_law == 1 and fast > 0.0
        self.stiffness, self.damping = device.bristle_stiffness, device.bristle_damping
        self.drag = self.damping * fast if self.bends else 0.0
        self.max_waves = MAX_WAVES if self.bends else inf

    def turning(self, velocity: float) -> float:
        """Theta [rad] at a slow velocity [m/s]; 0 or pi where the slider never reverses."""
        if abs(velocity) >= self.fast:
            return 0.0 if velocity > 0.0 else pi
        return acos(velocity / self.fast)

    def mean(self, load: VibratingLoad, turning: float) -> float:
        """Mean friction [N] when sliding turns forward at tau = `turning` [rad]."""
        total = load.integral(turning, tau - turning) - load.integral(-turning, turning)
        bending = sum(w * force for w, _, force in self._bending(turning, load))
        return self.faces * (self.coefficient * total + bending) / tau

    def power(self, load: VibratingLoad, velocity: float) -> float:
        """Mean power of friction [W] at a slow velocity [m/s]."""
        turning = self.turning(velocity)
        beyond = velocity - self.fast * cos(turning)
        nodes = self._bending(turning, load)
        for arc in self._arcs(turning):
            full = arc.direction * self.coefficient
            nodes += [(w, swing, full) for w, swing, _ in arc.nodes(arc.length, load)]
        work = sum(w * (swing * self.fast + beyond) * force for w, swing, force in nodes)
        return self.faces * work / tau

    def _arcs(self, turning: float) -> list["_Arc"]:
        """Sliding forward and backward."""
        forward = _Arc(self._reach, 1, turning, tau - 2.0 * turning)
        return [forward, _Arc(self._reach, -1, -turning, 2.0 * turning)]

    def _bending(self, turning: float, load: VibratingLoad) -> list[Node]:
        """Quadrature over both arcs of the friction that a bristle lacks before it is bent."""
        if not self.bends:
            return []
        mu, stiffness, arcs = self.coefficient, self.stiffness, self._arcs(turning)
        forward, backward = (-expm1(-stiffness * arc.way(arc.length)[1] / mu) for arc in arcs)
        # By the share of the bend that it makes up over each arc, friction where they begin.
        made_up = forward + backward - forward * backward
        first = mu * (forward * (1.0 - backward) - backward) / made_up if made_up else 0.0
        second = first + (mu - first) * forward
        nodes = []
        for arc, friction in zip(arcs, (first, second), strict=True):
            unbent, drag = friction - arc.direction * mu, arc.direction * self.drag
            if abs(unbent) > EPSILON * mu:
                for w, swing, path in arc.nodes(arc.bent_after(BENT * mu, stiffness), load):
                    lacking = unbent * exp(-stiffness * path / mu) * (1.0 - drag * swing / mu)
                    nodes.append((w, swing, lacking))
        return nodes


class _Arc(NamedTuple):
    """A part of the turn with one direction of sliding, from `begin` on for `length` [rad].

    The velocity is v_q (cos(begin) - cos(begin + ahead)); `reach` is v_q / w [m].
    """

    reach: float
    direction: int
    begin: float
    length: float

    def way(self, ahead: float) -> tuple[float, float]:
        """Velocity over v_q, and path [m], `ahead` [rad] of where the arc begins."""
        half = 0.5 * ahead
        rise = 2.0 * sin(half)
        moved = cos(self.begin) * (ahead - sin(ahead)) + 0.5 * sin(self.begin) * rise * rise
        return rise * sin(self.begin + half), self.direction * self.reach * moved

    def bent_after(self, full: float, stiffness: float) -> float:
        """How far ahead [rad] the path times `stiffness` [1/m] is `full`, or a little farther."""
        ahead = self.length
        while stiffness * self.way(0.9 * ahead)[1] > full:
            ahead *= 0.9
        return ahead

    def nodes(self, last: float, load: VibratingLoad) -> list[Node]:
        """Quadrature up to `last` [rad] ahead: weights with the load, velocities and paths.

        Velocities are those beyond where the slider turns, paths those since then. Panels part at
        kinks of the load, and none is wider than WIDEST of it.
        """
        kinks = (kink - self.begin for kink in load.kinks(self.begin, self.begin + last))
        found = []
        for low, high in pairwise(sorted([0.0, last, *kinks])):
            panels = 1 + int(abs(load.waves) * (high - low) / WIDEST)
            half = 0.5 * (high - low) / panels
            for i in range(panels):
                for node, weight in _RULE:
                    ahead = low + half * (2 * i + 1 + node)
                    found.append((weight * half * load.at(self.begin + ahead), *self.way(ahead)))
        return found


def fejer(count: int) -> tuple[tuple[float, float], ...]:
    """Nodes and weights of the first rule of Fejer on [-1, 1], for an even `count`."""
    angles = [pi * (i + 0.5) / count for i in range(count)]
    series = ([cos(2 * j * a) / (4 * j * j - 1) for j in range(1, count // 2)] for a in angles)
    weights = (2.0 / count * (1.0 - 2.0 * sum(terms)) for terms in series)
    return tuple(zip(map(cos, angles), weights, strict=True))


_RULE = fejer(NODES)
