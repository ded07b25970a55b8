"""Systems of a few linear equations."""

from __future__ import annotations

from math import isfinite

Vector = list[float]
Matrix = list[list[float]]

SMALLEST_PIVOT = 1e-13
"""Smallest pivot that counts as different from 0, relative to the largest entry of the matrix."""


def solve_linear(matrix: Matrix, right: Vector) -> Vector | None:
    """Return x of `matrix` x = `right`, by Gaussian elimination with row pivots.

    None where the matrix is singular up to rounding or not finite.
    """
    count = len(right)
    rows = [[*row[:count], value] for row, value in zip(matrix, right, strict=False)]
    smallest = SMALLEST_PIVOT * max(abs(entry) for row in rows for entry in row[:count])
    for k in range(count):
        pivot = k
        for i in range(k + 1, count):
            pivot = i if abs(rows[i][k]) > abs(rows[pivot][k]) else pivot
        if not abs(rows[pivot][k]) > smallest:
            return None
        rows[k], rows[pivot] = rows[pivot], rows[k]
        for i in range(k + 1, count):
            share = rows[i][k] / rows[k][k]
            for j in range(k + 1, count + 1):
                rows[i][j] -= share * rows[k][j]
    found = [0.0] * count
    for k in range(count - 1, -1, -1):
        rest = rows[k][count]
        for j in range(k + 1, count):
            rest -= rows[k][j] * found[j]
        found[k] = rest / rows[k][k]
    return found if all(map(isfinite, found)) else None
