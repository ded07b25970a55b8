"""How motion departs from a held orbit: the slow part by which V changes, and the fast vibration.

Bristle and resonator lag behind a velocity that changes, so friction acts as an added mass
kappa_m Mt on the slow motion. With P the period map, rho its slow multiplier, l its left
eigenvector, x_V the tangent dx/dV of the orbits and P_L what a unit of load adds to the state in a
period:

    1 + kappa_m = -Mt ln(rho) / (F2' T),    (1 - rho) l.x_V = -F2' l.P_L

F2' drops out, and where it vanishes the quotient stays regular.

Off the orbit by an excess force E = F2 + load the motion is x* + xi E, V changes by dV E in a
period, and E by the factor rho. That is the slow motion, so that the mean velocity of a period is
that of V:

    (P_x - rho) xi - x_V dV = -P_L,    X_x xi + X_L = (1 / ln(rho) + 1 / (1 - rho)) dV T
"""

from __future__ import annotations

from dataclasses import dataclass
from math import exp, isfinite, log, log1p

from .linear_system import Matrix, Vector, solve_linear

MULTIPLIER_ITERATIONS = 100
"""Most iterations of the slow multiplier: each leaves the share of the coupling that is left."""

SEPARATING_ITERATIONS = 6
"""Those of them that show whether it is separate."""

SEPARATED = 0.01
"""Change of its decay in the last of these, as a share, from which on there is no slow multiplier:
it is one of a pair with that of the vibration."""

CONVERGED = 1e-12
"""Change of its decay, as a share, from which on it is found."""

SMALL_DECAY = 1e-3
"""Decay in a period below which its series serves."""

MAX_DECAY = 0.5
"""Decay in a period from which on motion is stopped, and not slow.

Where the slow multiplier goes through 0 its logarithm makes much of rounding, and describes motion
no better than none.
"""

SQUARINGS = 24
"""Squarings of a matrix that leave its spectral radius to 1e-7."""


@dataclass(frozen=True, slots=True)
class OrbitLinearisation:
    """The slow and the fast part of the departure, in the scales of the period map.

    `factor` is 1 + kappa_m, 1 where `is_slow` is false: there the motion is stopped within some
    periods. `slope` is F2' T / Mt, `multiplier` rho, `fast_multiplier` the largest of the others
    in absolute value. `is_separate` says that rho is one multiplier by itself, and decays more
    slowly than the others. `tangent` is x_V, and `lag` xi, 0 where the motion is not slow.
    """

    is_slow: bool
    is_separate: bool
    factor: float
    slope: float
    multiplier: float
    fast_multiplier: float
    tangent: Vector
    lag: Vector


def linearised(jacobian: Matrix) -> OrbitLinearisation | None:
    """The linearisation, from the Jacobian of P(x, L) - x and of the mean velocity by x and L.

    None where it is singular.
    """
    states = len(jacobian) - 1
    tangent = solve_linear(jacobian, [0.0] * states + [1.0])
    slow = _slow_eigenvector(jacobian)
    if tangent is None or slow is None:
        return None
    left, decay, change = slow
    gained = -sum(left[i] * jacobian[i][states] for i in range(states))
    moved = sum(left[i] * tangent[i] for i in range(states))
    is_slow = decay < MAX_DECAY
    lag = _lag(jacobian, decay, tangent) if is_slow else [0.0] * states
    if lag is None:
        return None
    stretch = -log1p(-decay) / decay if is_slow and decay != 0.0 else 1.0
    fast = _fast_multiplier(jacobian, left)
    return OrbitLinearisation(
        is_slow=is_slow,
        is_separate=abs(change) <= SEPARATED * abs(decay) + SMALL_DECAY and fast < abs(1.0 - decay),
        factor=gained / moved * stretch if is_slow else 1.0,
        slope=-tangent[states],
        multiplier=1.0 - decay,
        fast_multiplier=fast,
        tangent=tangent[:states],
        lag=lag,
    )


def _slow_eigenvector(jacobian: Matrix) -> tuple[Vector, float, float] | None:
    """The left eigenvector of the slow multiplier, its first entry 1, and 1 - rho.

    With the change of 1 - rho in the iteration that shows whether it is separate.
    """
    fast = range(1, len(jacobian) - 1)
    left, decay, change = [1.0], 0.0, 0.0
    for iteration in range(1, MULTIPLIER_ITERATIONS + 1):
        matrix = [[jacobian[j][i] + (decay if i == j else 0.0) for j in fast] for i in fast]
        found = solve_linear(matrix, [-jacobian[0][i] for i in fast])
        if found is None:
            return None
        left, before = [1.0, *found], decay
        decay = -jacobian[0][0] - sum(left[i] * jacobian[i][0] for i in fast)
        change = decay - before if iteration == SEPARATING_ITERATIONS else change
        converged = abs(decay - before) <= CONVERGED * abs(decay)
        if converged and iteration >= SEPARATING_ITERATIONS:
            break
    return (left, decay, change) if isfinite(decay) else None


def _lag(jacobian: Matrix, decay: float, tangent: Vector) -> Vector | None:
    """The lag xi behind the orbit."""
    states = len(jacobian) - 1
    matrix = [
        [entry + (decay if i == j else 0.0) for j, entry in enumerate(row[:states])]
        + [-tangent[i] if i < states else -_mean_share(decay)]
        for i, row in enumerate(jacobian)
    ]
    found = solve_linear(matrix, [-row[states] for row in jacobian])
    return None if found is None else found[:states]


def _mean_share(decay: float) -> float:
    """By how much the mean of an exponential decay exceeds its start, over its change in a period.

    1 / ln(1 - d) + 1 / d.
    """
    return 0.5 + decay / 12.0 if abs(decay) < SMALL_DECAY else 1.0 / log1p(-decay) + 1.0 / decay


def _fast_multiplier(jacobian: Matrix, left: Vector) -> float:
    """The largest multiplier on the states in which the slow motion has no part."""
    fast = range(1, len(jacobian) - 1)
    return _spectral_radius(
        [[jacobian[i][j] + (i == j) - jacobian[i][0] * left[j] for j in fast] for i in fast]
    )


def largest_multiplier(jacobian: Matrix) -> float:
    """The largest multiplier in absolute value of motion under the load of the orbit.

    From the same Jacobian.
    """
    states = range(len(jacobian) - 1)
    return _spectral_radius([[jacobian[i][j] + (i == j) for j in states] for i in states])


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
