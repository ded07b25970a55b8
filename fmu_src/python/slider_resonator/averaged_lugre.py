"""Averaged LuGre friction under fast vibration, uniform in the bristle stiffness.

The slider moves with V - v_q cos(tau). Over one turn of tau the bristle response to that motion is
periodic, and explicit in the path between the two reversals, so the mean friction is a quadrature:
soft bristles give the paper's slow manifold (17), hard ones Coulomb friction (5).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, partial
from itertools import pairwise
from math import cos, exp, pi, sin, tau

from .bristle import Bristle
from .vibrating_load import VibratingLoad

NODES = 12
PANELS = (0.0, 0.05, 0.15, 0.35, 0.65, 1.0)
"""Panels of the quadrature over an arc; they crowd where sliding begins."""

BENT = 40.0
"""Path in units of mu / sigma_0 after which a bristle is fully bent to rounding."""


@dataclass(frozen=True, slots=True)
class FastMotion:
    """Fast velocity amplitude v_q [m/s] and drive frequency [rad/s]."""

    velocity: float
    frequency: float


def mean_friction(bristle: Bristle, fast: FastMotion, load: VibratingLoad, turning: float) -> float:
    """Mean friction [N] of one face when sliding turns forward at tau = `turning` [rad].

    `turning` in [0, pi] is arccos(V / v_q) for the slow velocity V.
    """
    velocity = fast.velocity * cos(turning)
    arcs = ((1, turning, tau - turning), (-1, -turning, turning))

    def path(sign: int, begin: float, end: float) -> float:
        moved = velocity * (end - begin) - fast.velocity * (sin(end) - sin(begin))
        return sign * moved / fast.frequency

    forward, backward = (path(*arc) for arc in arcs)
    friction = _periodic_friction(bristle, forward, backward)
    total = 0.0
    for sign, begin, end in arcs:
        limit = sign * bristle.coefficient
        total += limit * load.integral(begin, end)
        unbent = friction[sign] - limit
        last = _bent_at(bristle, partial(path, sign, begin), begin, end)
        for low, high in pairwise(PANELS):
            for node, weight in gauss_legendre(NODES):
                share = low + (high - low) * 0.5 * (1.0 + node)
                angle = begin + (last - begin) * share
                fade = exp(-bristle.stiffness * path(sign, begin, angle) / bristle.coefficient)
                drag = bristle.damping * (velocity - fast.velocity * cos(angle))
                force = unbent * fade * (1.0 - sign * drag / bristle.coefficient)
                total += weight * 0.5 * (high - low) * (last - begin) * load.at(angle) * force
    return total / tau


def _periodic_friction(bristle: Bristle, forward: float, backward: float) -> dict[int, float]:
    """sigma_0 z where the forward and the backward arc begin, for these paths [m]."""
    mu = bristle.coefficient
    kept_forward = exp(-bristle.stiffness * forward / mu)
    kept_backward = exp(-bristle.stiffness * backward / mu)
    lost = 1.0 - kept_forward * kept_backward
    if lost == 0.0:
        return {1: 0.0, -1: 0.0}
    at_forward = mu * ((1.0 - kept_forward) * kept_backward - (1.0 - kept_backward)) / lost
    return {1: at_forward, -1: mu + (at_forward - mu) * kept_forward}


def _bent_at(bristle: Bristle, path: Callable[[float], float], begin: float, end: float) -> float:
    """Angle in [begin, end] from which the bristle is fully bent."""
    full = BENT * bristle.coefficient
    if bristle.stiffness * path(end) <= full:
        return end
    low, high = begin, end
    for _ in range(60):
        middle = 0.5 * (low + high)
        if bristle.stiffness * path(middle) < full:
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
