/* The law of the values of a component. */
#ifndef COMPONENT_LAW_H
#define COMPONENT_LAW_H

#include <stdbool.h>
#include <stddef.h>

#include "friction_table.h"
#include "law.h"
#include "orbit_tables.h"
#include "refusal.h"
#include "variables.h"

bool all_finite(const double *numbers, size_t count);

/* The inputs among `values`, with the phase reduced to [-pi, pi]. */
Inputs reduced_inputs(const double values[SETTABLE_COUNT]);

/* Prepare the law of `values` and, if it follows orbits, the law of the full device (`resolved`). `table`
 * and `orbits` are caches that outlive the laws. Refuse values that do not fit together; `law` and
 * `resolved` are then undefined. */
bool prepare_law(const double values[SETTABLE_COUNT], FrictionTable *table, OrbitTables *orbits,
                 Law *law, Law *resolved, Refusal *refusal);

/* Refuse a step of `step_size` [s] that spans too many turns of the fastest oscillation. */
bool bounded_work_check(const Law *law, double step_size, Refusal *refusal);

#endif
