/* Systems of a few linear equations. */
#ifndef SLIDER_LINEAR_SYSTEM_H
#define SLIDER_LINEAR_SYSTEM_H

#include <stdbool.h>

/* Most unknowns of a system. */
enum { UNKNOWNS = 5 };

/* Solves `matrix` x = `right` for the first `count` <= UNKNOWNS unknowns, by elimination with row
 * pivots. `right` becomes x, `matrix` is kept. Returns false, with `right` undefined, where the
 * matrix is singular beyond rounding or not finite. */
bool solve_linear(double matrix[UNKNOWNS][UNKNOWNS], double right[UNKNOWNS], int count);

#endif
