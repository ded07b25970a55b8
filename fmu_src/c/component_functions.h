/* What a component can do, so that those who speak FMI need not know which it is: `component.h`
 * defines `Component` before it includes this.
 *
 * Every function leaves the component as it was when it refuses. */
#ifndef COMPONENT_FUNCTIONS_H
#define COMPONENT_FUNCTIONS_H

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
