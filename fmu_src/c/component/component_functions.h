/* The functions of a component, the same for every native FMU. `component.h` defines `Component` before it includes
 * this.
 *
 * A function that refuses leaves the component as it was. */
#pragma once

#include "../base/memory.h"

/* Let a new component, zeroed memory, take what it needs later from `memory`, or give all of that back. */
void component_begin(Component *component, const Memory *memory);
void component_end(Component *component);

/* Give the component, a new one or one in use, its start values. */
void component_reset(Component *component);

bool component_setup_experiment(Component *component, const Experiment *experiment, Refusal *refusal);
bool component_enter_initialization(Component *component, Refusal *refusal);

/* Fix the parameters and the first moment. */
bool component_exit_initialization(Component *component, Refusal *refusal);

/* End the simulation; outputs stay readable. */
bool component_terminate(Component *component, Refusal *refusal);

/* Set inputs and parameters by reference: all of them or, if one is refused, none. */
bool component_set(Component *component, const unsigned *references, const double *values, size_t count,
                   Refusal *refusal);

/* Get values of any variables: all or none; outputs from initialization mode on. */
bool component_get(Component *component, const unsigned *references, double *values, size_t count, Refusal *refusal);

/* Advance from the present `time` [s] by `step_size` > 0 [s], inputs held. */
bool component_step(Component *component, double time, double step_size, Refusal *refusal);

/* Restore a snapshot, of this or another component. */
bool component_restore(Component *component, const Snapshot *snapshot, Refusal *refusal);
