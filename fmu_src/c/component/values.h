/* Values of variables by reference: what a host may read and set. */
#pragma once

#include <stddef.h>

#include "lifecycle.h"
#include "variables.h"

#if defined(__FAST_MATH__) || defined(_M_FP_FAST) || defined(__ASSOCIATIVE_MATH__) || \
    (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error \
    "compile without -ffast-math, -fassociative-math, -ffinite-math-only, /fp:fast: they remove rounding or checks for NaN"
#endif

/* Refuse a value that the table excludes. */
bool value_check(const Variable *variable, double value, Refusal *refusal);

/* Refuse to read outputs before initialization mode. */
bool reading_check(Lifecycle lifecycle, unsigned reference, Refusal *refusal);

/* The start values of the table. */
void start_values(double values[SETTABLE_COUNT]);

/* Change `count` of `values` by reference. Refuse to set outputs, fixed parameters while running, anything after the
 * end, and values that the table excludes; `values` are then undefined. */
bool change_values(double values[SETTABLE_COUNT], Lifecycle lifecycle, const unsigned *references,
                   const double *changes, size_t count, Refusal *refusal);

/* The value as messages show it: integers without a point. Returns `text`. */
const char *value_text(const Variable *variable, double value, char text[NUMBER_SIZE]);
