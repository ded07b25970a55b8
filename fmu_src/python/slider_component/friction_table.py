"""The means of friction over a turn of the drive, tabulated over the slow velocity.

Averaged motion asks for them several times a step, and each costs a quadrature. They are smooth in
Theta = arccos(V / v_q), with a layer at its ends that gets thinner for harder bristles: polynomials
on panels, halved until they hold. Turning Theta into pi - Theta mirrors the motion: half is kept.
"""

from __future__ import annotations

from bisect import bisect_right
from dataclasses import dataclass
from math import cos, pi

from .averaged_friction import AveragedFriction, FastMotion, FrictionMeans
from .bristle import Bristle

DEGREE = 8
"""Degree of the polynomials."""

CHECKED = (-0.95, -0.85, -0.5, 0.35)
"""Places in a panel, which stands for [-1, 1], where a polynomial is compared with the means."""

MAX_ERROR = 1e-8
"""Error of the means that a panel may have where it is checked, as a share of mu or of the largest
mean on the panel where that is larger."""

MAX_WAVES_TABULATED = 8
"""Waves of the normal load over a turn up to which a table takes less time than it saves."""

MAX_HALVINGS = 24
"""Halvings of a panel after which it is taken as it is, a fraction 6e-8 of the whole."""

MAX_PANELS = 32
"""Panels after which all are taken as they are: bounds the work. Harder bristles need more of them,
19 at kappa 1e17."""

Polynomial = tuple[float, float, float, float, float, float, float, float, float]
"""Coefficients, that of the highest power first."""

Polynomials = tuple[Polynomial, Polynomial, Polynomial]


@dataclass(frozen=True, slots=True)
class FrictionTable:
    """Upper ends of the panels, rising to pi / 2 [rad], and on each the polynomials of the means.

    `ends[0]` is 0 and opens the first panel. `mirrored` is the sign of sine and cosine mean in the
    mirrored half.
    """

    coefficient: float
    ends: tuple[float, ...]
    panels: tuple[Polynomials, ...]
    mirrored: float

    def at(self, turning: float) -> tuple[float, float, float]:
        """Plain, sine and cosine mean when sliding turns forward at tau = `turning` [rad]."""
        back = turning > 0.5 * pi
        angle = pi - turning if back else turning
        ends, panels = self.ends, self.panels
        index = bisect_right(ends, angle, 1, len(panels)) - 1
        low, high = ends[index], ends[index + 1]
        x = (2.0 * angle - low - high) / (high - low)
        plain, sine, cosine = panels[index]
        if back:
            return (
                -_value(plain, x),
                self.mirrored * _value(sine, x),
                self.mirrored * _value(cosine, x),
            )
        return _value(plain, x), _value(sine, x), _value(cosine, x)


def friction_table(
    friction: AveragedFriction, bristle: Bristle, fast: FastMotion, n: int
) -> FrictionTable:
    """The means under n waves of the normal load over a turn, n not 0, to MAX_ERROR."""
    ends = [0.0]
    panels: list[Polynomials] = []
    # Panels still to be made, the next one last: width in halvings of the whole, and the panel.
    todo = [(0, 0.0, 0.5 * pi)]
    while todo:
        halvings, low, high = todo.pop()
        polynomials, error = _panel(friction, bristle, fast, n, low, high)
        full = len(panels) + len(todo) + 1 >= MAX_PANELS
        if error <= MAX_ERROR or halvings == MAX_HALVINGS or full:
            ends.append(high)
            panels.append(polynomials)
        else:
            middle = 0.5 * (low + high)
            todo += [(halvings + 1, middle, high), (halvings + 1, low, middle)]
    mirrored = -1.0 if n % 2 == 0 else 1.0
    return FrictionTable(bristle.coefficient, tuple(ends), tuple(panels), mirrored)


def _panel(
    friction: AveragedFriction, bristle: Bristle, fast: FastMotion, n: int, low: float, high: float
) -> tuple[Polynomials, float]:
    """Interpolation of the means on a panel, and its largest relative error where checked."""

    def means(x: float) -> FrictionMeans:
        return friction.means(bristle, fast, n, 0.5 * (low + high + (high - low) * x))

    at_nodes = [means(x) for x in _NODES]
    plain, sine, cosine = (_polynomial([m[kind] for m in at_nodes]) for kind in range(3))
    polynomials = plain, sine, cosine
    size = max(bristle.coefficient, *(abs(mean) for m in at_nodes for mean in m))
    error = 0.0
    for x in (*CHECKED, *_layer(bristle, fast, low, high)):
        misses = (abs(_value(p, x) - m) for p, m in zip(polynomials, means(x), strict=True))
        error = max(error, *misses)
    return polynomials, error / size


def _layer(bristle: Bristle, fast: FastMotion, low: float, high: float) -> tuple[float, ...]:
    """Where in a panel the backward path is about mu / sigma_0 long: hard bristles bend there."""
    if bristle.stiffness == 0.0:
        return ()
    length = bristle.coefficient * fast.frequency / (bristle.stiffness * fast.velocity)
    angle = length ** (1.0 / 3.0)
    return ((2.0 * angle - low - high) / (high - low),) if low < angle < high else ()


def _value(polynomial: Polynomial, x: float) -> float:
    c8, c7, c6, c5, c4, c3, c2, c1, c0 = polynomial
    return (((((((c8 * x + c7) * x + c6) * x + c5) * x + c4) * x + c3) * x + c2) * x + c1) * x + c0


def _polynomial(values: list[float]) -> Polynomial:
    """The polynomial that takes these values at the nodes."""
    c8, c7, c6, c5, c4, c3, c2, c1, c0 = (
        sum(weight * value for weight, value in zip(row, values, strict=True)) for row in _WEIGHTS
    )
    return c8, c7, c6, c5, c4, c3, c2, c1, c0


def _interpolation_weights() -> tuple[tuple[float, ...], ...]:
    """Row k gives the coefficient of the k-th highest power of x from the values at the nodes."""
    columns = []
    for j, node in enumerate(_NODES):
        # The Lagrange polynomial of this node, by multiplying out its roots.
        polynomial, scale = [1.0], 1.0
        for i, other in enumerate(_NODES):
            if i != j:
                shifted = [0.0] + [-other * c for c in polynomial]
                polynomial = [a + b for a, b in zip([*polynomial, 0.0], shifted, strict=True)]
                scale *= node - other
        columns.append([c / scale for c in polynomial])
    return tuple(zip(*columns, strict=True))


_NODES = tuple(cos(pi * (k + 0.5) / (DEGREE + 1)) for k in range(DEGREE + 1))
_WEIGHTS = _interpolation_weights()
