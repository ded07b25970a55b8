/* The law of the values of a component. */
#ifndef COMPONENT_LAW_H
#define COMPONENT_LAW_H

#include <stdbool.h>
#include <stddef.h>

#include "../base/refusal.h"
#include "../resolved/motion.h"
#include "variables.h"

bool all_finite(const double *numbers, size_t count);

/* The inputs among `values`, with the phase reduced to [-pi, pi]. */
Inputs reduced_inputs(const double values[SETTABLE_COUNT]);

/* The device of `values`, with the deviations of its drive. */
Device driven_device(const double values[SETTABLE_COUNT]);

/* The motion of a device, by its fidelity and averaging order; `device` becomes the one that this motion moves. */
const Motion *motion_of(Device *device);

/* Prepare the law of `values`, without tables. Refuse values that do not fit together; `law` is then undefined. */
bool prepare_law(const double values[SETTABLE_COUNT], Law *law, Refusal *refusal);

#endif
