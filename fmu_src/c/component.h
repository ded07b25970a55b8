/* The component between numerics and FMI: values by reference, time, initialization, steps.
 *
 * Every function leaves the component as it was when it refuses. */
#ifndef SLIDER_COMPONENT_H
#define SLIDER_COMPONENT_H

#include <stdbool.h>
#include <stddef.h>

#include "experiment.h"
#include "friction_table.h"
#include "law.h"
#include "outputs.h"
#include "refusal.h"
#include "snapshot.h"

/* A slider-resonator. `now` is all that decides how a run goes on. The rest follows from it and is
 * kept beside: the law of the present values (where `prepared`) in one of two places, so that the
 * next one can be tried in the other. A component must not move: its laws point to its table. */
typedef struct {
    Snapshot now;
    bool prepared;
    int present;
    Law laws[2];
    FrictionTable table;
    Theory theory;
} Component;

/* Makes a new component of zeroed memory, or of one that was used. */
void component_reset(Component *component);

bool component_setup_experiment(Component *component, const Experiment *experiment,
                                Refusal *refusal);
bool component_enter_initialization(Component *component, Refusal *refusal);

/* Fixes the parameters and the first moment. */
bool component_exit_initialization(Component *component, Refusal *refusal);

/* Ends the simulation; outputs stay readable. */
bool component_terminate(Component *component, Refusal *refusal);

/* Sets inputs and parameters by reference: all of them or, if one is refused, none. */
bool component_set(Component *component, const unsigned *references, const double *values,
                   size_t count, Refusal *refusal);

/* Values of any variables, all or none; outputs from initialization mode on. */
bool component_get(Component *component, const unsigned *references, double *values, size_t count,
                   Refusal *refusal);

/* Advances from `time` [s], the present one, by `step_size` > 0 [s], inputs held. */
bool component_step(Component *component, double time, double step_size, Refusal *refusal);

/* Goes back to a snapshot, of this or another component. */
bool component_restore(Component *component, const Snapshot *snapshot, Refusal *refusal);

#endif
