"""How motion departs from a held orbit: the slow part by which V changes, and the fast vibration.

Bristle and resonator lag behind a velocity that changes, so friction acts as an added mass
kappa_m Mt on the slow motion. With P the period map, rho its slow multiplier, l its left
eigenvector, x_V the tangent dx/dV of the orbits and P_L what a unit of load adds to the state in a
period:

    1 + kappa_m = -Mt ln(rho) / (F2' T),    (1 - rho) l.x_V = -F2' l.P_L

F2' drops out, and where it vanishes the quotient stays regular.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import exp, isfinite, log, log1p

from .linear_system import Matrix, Vector, solve_linear

MULTIPLIER_ITERATIONS = 6
"""Iterations of the slow multiplier, each of which leaves the share of the coupling that is left."""

SQUARINGS = 24
"""Squarings of a matrix that leave its spectral radius to 1e-7."""


@dataclass(frozen=True, slots=True)
class OrbitLinearisation:
    """The slow and the fast part of the departure, in the scales of the period map.

    `factor` is 1 + kappa_m, 1 where `is_slow` is false: there the motion is stopped within a
    period. `slope` is F2' T / Mt, `multiplier` rho, `fast_multiplier` the largest of the others in
    absolute value, and `tangent` x_V.
    """

    is_slow: bool
    factor: float
    slope: float
    multiplier: float
    fast_multiplier: float
    tangent: Vector


def linearised(jacobian: Matrix) -> OrbitLinearisation | None:
    """The linearisation, from the Jacobian of P(x, L) - x and of the mean velocity by x and L.

    None where it is singular.
    """
    states = len(jacobian) - 1
    tangent = solve_linear(jacobian, [0.0] * states + [1.0])
    slow = _slow_eigenvector(jacobian)
    if tangent is None or slow is None:
        return None
    left, decay = slow
    gained = -sum(left[i] * jacobian[i][states] for i in range(states))
    moved = sum(left[i] * tangent[i] for i in range(states))
    is_slow = decay < 1.0
    stretch = -log1p(-decay) / decay if is_slow and decay != 0.0 else 1.0
    return OrbitLinearisation(
        is_slow=is_slow,
        factor=gained / moved * stretch if is_slow else 1.0,
        slope=-tangent[states],
        multiplier=1.0 - decay,
        fast_multiplier=_fast_multiplier(jacobian, left),
        tangent=tangent,
    )


def _slow_eigenvector(jacobian: Matrix) -> tuple[Vector, float] | None:
    """The left eigenvector of the slow multiplier, its first entry 1, and 1 - rho."""
    fast = range(1, len(jacobian) - 1)
    left, decay = [1.0], 0.0
    for _ in range(MULTIPLIER_ITERATIONS):
        matrix = [[jacobian[j][i] + (decay if i == j else 0.0) for j in fast] for i in fast]
        found = solve_linear(matrix, [-jacobian[0][i] for i in fast])
        if found is None:
            return None
        left = [1.0, *found]
        decay = -jacobian[0][0] - sum(left[i] * jacobian[i][0] for i in fast)
    return (left, decay) if isfinite(decay) else None


def _fast_multiplier(jacobian: Matrix, left: Vector) -> float:
    """The largest multiplier on the states in which the slow motion has no part."""
    fast = range(1, len(jacobian) - 1)
    return _spectral_radius(
        [[jacobian[i][j] + (i == j) - jacobian[i][0] * left[j] for j in fast] for i in fast]
    )


def _spectral_radius(matrix: Matrix) -> float:
    logarithm, weight, indices = 0.0, 1.0, range(len(matrix))
    for _ in range(SQUARINGS):
        largest = max(abs(entry) for row in matrix for entry in row)
        if not largest > 0.0:
            return 0.0
        scaled = [[entry / largest for entry in row] for row in matrix]
        matrix = [
            [sum(scaled[i][k] * scaled[k][j] for k in indices) for j in indices] for i in indices
        ]
        logarithm += weight * log(largest)
        weight *= 0.5
    return exp(logarithm)
