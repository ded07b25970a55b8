"""Newton's method for the equations of an orbit: damped, with Broyden's updates of the Jacobian."""

from __future__ import annotations

from math import inf
from typing import NamedTuple

from .linear_system import Matrix, Vector
from .orbit_equations import DIFFERENCE, OrbitEquations, Trial, largest

MAX_MAPS = 120
"""Largest number of period maps for an orbit, Jacobians included."""

COULOMB_CONVERGED = 1e-13
"""Correction of the unknowns, in their scales, below which an orbit is found."""

LUGRE_CONVERGED = 1e-12
"""The same under LuGre friction."""

ROUNDED = 1e-9
"""Correction up to which an orbit is found where corrections no longer decrease, by rounding."""

SMALLEST_PART = 0.015
"""Smallest damping factor of a Newton step."""


class Solution(NamedTuple):
    """The end of the iteration: unknowns, trial, mean velocity and Jacobian at the orbit."""

    unknowns: Vector
    trial: Trial
    mean_velocity: float
    jacobian: Matrix


def solved(
    equations: OrbitEquations, unknowns: Vector, trial: Trial, known: Matrix | None
) -> Solution | None:
    """Solve from `unknowns` and their trial on, with a Jacobian kept as long as it contracts.

    `known` is a Jacobian of a neighbour. None where the iteration does not converge within
    `MAX_MAPS`.
    """
    accuracy = LUGRE_CONVERGED if equations.map.states > 3 else COULOMB_CONVERGED
    jacobian, fresh = known, False
    before = inf
    while equations.maps < MAX_MAPS:
        if jacobian is None:
            jacobian, fresh = equations.jacobian(unknowns, trial), True
            if jacobian is None:
                break
        step = equations.newton_step(jacobian, trial.values, unknowns)
        size = largest(step)
        if step is not None and (size <= accuracy or (size <= ROUNDED and size > 0.5 * before)):
            mean = trial.values[-1] + sum(a * b for a, b in zip(jacobian[-1], step, strict=True))
            return Solution(unknowns_after(unknowns, step, 1.0), trial, mean, jacobian)
        accepted = _accepted(equations, unknowns, jacobian, step, fresh)
        if accepted is not None:
            following, other, part = accepted
            if part * size > DIFFERENCE:
                jacobian = _updated(jacobian, unknowns, trial, following, other)
            unknowns, trial, fresh, before = following, other, False, size
        elif size <= ROUNDED:
            return Solution(unknowns, trial, trial.values[-1], jacobian)
        elif fresh:
            break
        else:
            jacobian = None
    return None


def _accepted(
    equations: OrbitEquations, unknowns: Vector, jacobian: Matrix, step: Vector | None, fresh: bool
) -> tuple[Vector, Trial, float] | None:
    """The unknowns after the largest part of a step that contracts, and that part.

    Parts below 1 are tried only with a fresh Jacobian.
    """
    part, size = 1.0, largest(step)
    while step is not None and part > SMALLEST_PART and equations.maps < MAX_MAPS:
        following = unknowns_after(unknowns, step, part)
        other = equations.attempt(following)
        if other is not None:
            left = largest(equations.newton_step(jacobian, other.values, following))
            if left <= (1.0 - 0.25 * part) * size:
                return following, other, part
        if not fresh or size <= ROUNDED:
            break
        part *= 0.25
    return None


def unknowns_after(unknowns: Vector, step: Vector, part: float) -> Vector:
    """The unknowns after a part of a step."""
    return [a + part * b for a, b in zip(unknowns, step, strict=True)]


def _updated(
    jacobian: Matrix, unknowns: Vector, trial: Trial, following: Vector, other: Trial
) -> Matrix:
    """Broyden's update: the Jacobian that maps the move to the change of the values.

    It is otherwise unchanged.
    """
    moved = [a - b for a, b in zip(following, unknowns, strict=True)]
    square = sum(a * a for a in moved)
    updated = []
    for row, after, before in zip(jacobian, other.values, trial.values, strict=True):
        missed = after - before - sum(a * b for a, b in zip(row, moved, strict=True))
        updated.append([a + missed * b / square for a, b in zip(row, moved, strict=True)])
    return updated
