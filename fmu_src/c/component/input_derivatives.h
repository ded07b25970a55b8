/* First derivatives of inputs: over a step inputs vary linearly.
 *
 * Like a value, a derivative holds until it is set again. An input that is set after a step without its derivative is
 * held from then on. */
#pragma once

#include <stddef.h>

#include "lifecycle.h"

/* The inputs that may vary over a step are the first variables: phase, load and frequency ratio. */
enum { VARYING_COUNT = 3 };

/* The derivative of an input, per s. It `is_new`, 1 or 0, until a step has been made with it. */
typedef struct {
    double value, is_new;
} InputDerivative;

/* Whether any input varies: has a derivative other than 0. */
bool inputs_vary(const InputDerivative derivatives[VARYING_COUNT]);

/* Change derivatives by reference. Refuse derivatives of other variables, any derivative after the end, and values that
 * are not finite; `derivatives` are then as they were. */
bool change_derivatives(InputDerivative derivatives[VARYING_COUNT], Lifecycle lifecycle, const unsigned *references,
                        const double *values, size_t count, Refusal *refusal);

/* Hold inputs that were set by reference, except those with new derivatives. */
void hold_inputs(InputDerivative derivatives[VARYING_COUNT], const unsigned *references, size_t count);

/* Note that a step was made: no derivative is new any more. */
void derivatives_used(InputDerivative derivatives[VARYING_COUNT]);
