/* The controller between its law and FMI: values by reference, time, initialization, steps.
 *
 * The functions are those that the slider's component has, so that both FMUs share the files that
 * speak FMI. Every function leaves the component as it was when it refuses. */
#ifndef CONTROLLER_COMPONENT_H
#define CONTROLLER_COMPONENT_H

#include <stdbool.h>
#include <stddef.h>

#include "experiment.h"
#include "refusal.h"
#include "snapshot.h"

/* A velocity controller; `now` is all there is. */
typedef struct {
    Snapshot now;
} Component;

/* Makes a new component of any memory. */
void component_reset(Component *component);

bool component_setup_experiment(Component *component, const Experiment *experiment,
                                Refusal *refusal);
bool component_enter_initialization(Component *component, Refusal *refusal);
bool component_exit_initialization(Component *component, Refusal *refusal);

/* Ends the simulation; outputs stay readable. */
bool component_terminate(Component *component, Refusal *refusal);

/* Sets inputs and parameters by reference: all of them or, if one is refused, none. */
bool component_set(Component *component, const unsigned *references, const double *values,
                   size_t count, Refusal *refusal);

/* Values of any variables, all or none; outputs from initialization mode on. */
bool component_get(Component *component, const unsigned *references, double *values, size_t count,
                   Refusal *refusal);

/* Advances from `time` [s], the present one, by `step_size` > 0 [s]: takes the samples that fall
 * due from the start of the step up to, not including, its end, of the inputs held over it. */
bool component_step(Component *component, double time, double step_size, Refusal *refusal);

/* Goes back to a snapshot, of this or another component. */
bool component_restore(Component *component, const Snapshot *snapshot, Refusal *refusal);

#endif
