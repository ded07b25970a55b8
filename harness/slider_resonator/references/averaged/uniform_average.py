"""LuGre friction averaged over the fast motion without assuming a bristle slower or faster than it.

The fast velocity V - q cos(theta) has a periodic bristle response, explicit from the path: between
reversals s0 z relaxes to +-mu with the distance slid. Its friction, weighted with the load and
integrated numerically over a turn, is the mean friction. For kappa = sigma_0 q / (mu Omega) -> 0 it
is the slow manifold of the paper, (16), for large ones Coulomb friction, (4). Errors are
O(1 / Omega). The contact may lift (``amplitude_ratio`` > 1).
"""

import math
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.references.averaged.vibrating_contact import (
    closed_spans,
    mean_load,
    turns_until_repeat,
)

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(24)


@dataclass(frozen=True)
class LugreCase:
    """Parameters of (9) without bristle stiffness and frequency.

    Dimensionless as below (9), in units of ``x0 = N0 / (m w0^2)`` and ``1 / w0``, or SI. They are
    q = F_T / Omega > 0, alpha = dN / N0, phi in rad, mu > 0 and sigma_1.
    """

    strength: float = 1.0
    amplitude_ratio: float = 1.0
    phase: float = math.pi / 2.0
    friction_coefficient: float = 0.4
    damping: float = 1.0


def mean_friction(
    velocity: float, case: LugreCase, stiffness: float, frequency: float, ratio: float = 1
) -> float:
    """Return the friction averaged over a turn, in units of N0, at a slow velocity.

    ``stiffness`` is sigma_0 > 0, ``frequency`` Omega, both in the units of the case. ``ratio`` is
    that of the frequency of the normal load to that of the drive. Where the load never repeats (see
    `turns_until_repeat`) only its mean counts. Raises ValueError for another stiffness.
    """
    if not stiffness > 0.0:
        raise ValueError(f"stiffness = {stiffness!r} must be greater than 0")
    q, mu = case.strength, case.friction_coefficient
    turns = turns_until_repeat(case.amplitude_ratio, ratio)
    load = mean_load(1.0, case.amplitude_ratio, case.phase, ratio)
    if turns == 0:
        constant = replace(case, amplitude_ratio=0.0)
        return load * mean_friction(velocity, constant, stiffness, frequency)
    if abs(velocity) >= q:
        return math.copysign(mu, velocity) * load
    turn = math.acos(velocity / q)
    rate = stiffness / (mu * frequency)
    backward = 2.0 * rate * (q * math.sin(turn) - velocity * turn)
    forward = 2.0 * rate * (q * math.sin(turn) + velocity * (math.pi - turn))
    # s0 z / mu where forward sliding ends, of the response that repeats every turn.
    gained = -math.expm1(-forward) + math.exp(-forward) * math.expm1(-backward)
    turned_backward = gained / -math.expm1(-forward - backward)
    turned_forward = turned_backward + (1.0 + turned_backward) * math.expm1(-backward)
    later = [replace(case, phase=case.phase + 2.0 * math.pi * k * ratio) for k in range(1, turns)]
    total = 0.0
    for start, end, sign, share in (
        (-turn, turn, -1.0, turned_backward),
        (turn, 2.0 * math.pi - turn, 1.0, turned_forward),
    ):
        for in_turn in (case, *later):
            total += _arc(velocity, in_turn, rate, (start, end), sign, share, ratio)
    return mu * total / (2.0 * math.pi * turns)


def _arc(
    velocity: float,
    case: LugreCase,
    rate: float,
    arc: tuple[float, float],
    sign: float,
    share: float,
    ratio: float,
) -> float:
    """Return the integral of load times friction over mu on an arc of sliding in one direction.

    ``share`` is s0 z / mu where the arc begins.
    """
    start, _ = arc
    q, mu = case.strength, case.friction_coefficient
    # Panels halve toward the reversal: in the smallest one the bristle relaxes by less than e.
    path = rate * (abs(velocity) + q) * (arc[1] - start)
    halvings = min(max(math.ceil(math.log2(max(path, 1.0))), 3), 30)
    past, weights = _nodes(arc, case, ratio, halvings)
    # The difference of sines as a product keeps its digits next to the reversal.
    slid = velocity * past - 2.0 * q * np.cos(start + 0.5 * past) * np.sin(0.5 * past)
    speed = velocity - q * np.cos(start + past)
    bristle = sign + (share - sign) * np.exp(-rate * sign * slid)
    friction = bristle + case.damping / mu * (speed - np.abs(speed) * bristle)
    normal = 1.0 + case.amplitude_ratio * np.sin(ratio * (start + past) + case.phase)
    return float((weights * normal) @ friction)


def _nodes(
    arc: tuple[float, float], case: LugreCase, ratio: float, halvings: int
) -> tuple[Array, Array]:
    """Return nodes in (0, width of the arc), where the contact is closed, and weights, flat arrays.

    Panels halve toward 0, so many times, and end where the contact opens or closes.
    """
    start, end = arc
    width = end - start
    # On 2 rad of the angle of the load the nodes integrate its sine to rounding.
    even = 1 + math.ceil(abs(ratio) * width / 2.0)
    spans = closed_spans(start, end, case.amplitude_ratio, case.phase, ratio)
    if spans == [arc]:
        unit_nodes, unit_weights = _unit_nodes(halvings, even)
        return width * unit_nodes, width * unit_weights
    edges = width * _unit_edges(halvings, even)
    nodes, weights = [np.empty(0)], [np.empty(0)]
    for first, last in spans:
        inner = edges[(edges > first - start) & (edges < last - start)]
        panels = np.concatenate([[first - start], inner, [last - start]])
        on_span, its_weights = _gauss(panels)
        nodes.append(on_span)
        weights.append(its_weights)
    return np.concatenate(nodes), np.concatenate(weights)


@lru_cache(maxsize=256)
def _unit_nodes(halvings: int, even: int) -> tuple[Array, Array]:
    """Return nodes and weights on an arc of width 1 on which the contact is closed."""
    return _gauss(np.append(0.0, _unit_edges(halvings, even)))


@lru_cache(maxsize=256)
def _unit_edges(halvings: int, even: int) -> Array:
    """Return where panels end in (0, 1]: halved toward 0, and at ``even`` equal distances."""
    edges = np.union1d(0.5 ** np.arange(halvings, -1, -1.0), np.linspace(0.0, 1.0, even))
    return edges[edges > 0.0]


def _gauss(edges: Array) -> tuple[Array, Array]:
    """Return the nodes and weights of panels between edges, flat arrays."""
    half = 0.5 * np.diff(edges)[:, None]
    return (edges[:-1, None] + half * (1.0 + _NODES)).ravel(), (half * _WEIGHTS).ravel()
