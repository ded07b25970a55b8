"""One-sided multipliers of a periodic motion, for period maps with a kink.

Where sliding reverses in flight, neighbouring motions may have the same friction and repeat, too.
Such a family ends in a kink of the period map, across which a central difference is meaningless. So
one neighbour is followed on each side: at a given distance in the slowest direction, and periodic
in all others.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from slider_resonator.steady.newton import Matrix, Vector

DISTANCE = 1e-3
"""Distance of the neighbours, in units of the scale."""

CORRECTIONS = 2
"""Newton steps that make a neighbour periodic in the fast directions."""


def one_sided_multipliers(
    change: Callable[[Vector], Vector], x: Vector, jacobian: Matrix, scale: Vector
) -> tuple[float, float] | None:
    """Return the slowest multiplier below and above the zero `x` (n,) of `change`.

    `jacobian` (n, n) is that of `change` at `x`. None where the slowest departure oscillates, or
    two directions are equally slow.
    """
    scaled = jacobian * scale[None, :] / scale[:, None]
    values, right = np.linalg.eig(scaled)
    slowest = int(np.argmax(np.abs(values + 1.0)))
    if values[slowest].imag != 0.0:
        return None
    try:
        left = np.linalg.inv(right)[slowest].real
        direction = right[:, slowest].real / float(left @ right[:, slowest].real)
        border = np.block([[scaled, direction[:, None]], [left[None, :], np.zeros((1, 1))]])
        below, above = (
            _multiplier(change, x, scale, border, side * DISTANCE) for side in (-1.0, 1.0)
        )
    except np.linalg.LinAlgError:
        return None
    return below, above


def _multiplier(
    change: Callable[[Vector], Vector], x: Vector, scale: Vector, border: Matrix, distance: float
) -> float:
    """Return the distance after a period over `distance`."""
    direction, left = border[:-1, -1], border[-1, :-1]
    y = distance * direction
    for _ in range(CORRECTIONS):
        value = change(x + scale * y) / scale
        y = y + np.linalg.solve(border, np.append(-value, distance - left @ y))[:-1]
    return 1.0 + float(left @ (change(x + scale * y) / scale)) / distance
