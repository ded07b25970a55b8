/* Systems of a few linear equations. */
#pragma once

#include <stdbool.h>

/* Largest number of unknowns. */
enum { UNKNOWNS = 5 };

/* Solves `matrix` x = `right` for `count` <= UNKNOWNS unknowns, by the elimination of Gauss and Jordan with row pivots.
 * `right` becomes x, `matrix` is unchanged. Returns false, with `right` undefined, where the matrix is singular up to
 * rounding or not finite. */
bool solve_linear(double matrix[UNKNOWNS][UNKNOWNS], double right[UNKNOWNS], int count);
