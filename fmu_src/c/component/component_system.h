/* The system of the values of a component. */
#pragma once

#include "../base/memory.h"
#include "../resolved/motion.h"
#include "variables.h"

/* Tables of friction, to which systems point. They take far more memory than the rest: each is NULL until a system
 * needs it, and stays. */
typedef struct {
    Memory memory;                 /* of the host, where they come from */
    struct FrictionTables *means;  /* means of friction of bristles, in averaged motion */
    struct BendingTables *bending; /* panels of bending bristles, in resolved motion */
} Tables;

bool all_finite(const double *numbers, size_t count);

/* The inputs among `values`, with the phase reduced to [-pi, pi]. */
Inputs reduced_inputs(const double values[SETTABLE_COUNT]);

/* Prepare the system of `values`, and the tables that it needs. Refuse values that do not fit together; `system` is
 * then undefined. */
bool prepare_system(const double values[SETTABLE_COUNT], Tables *tables, System *system, Refusal *refusal);
