/* The component between numerics and FMI: values by reference, lifecycle, steps. */
#ifndef SLIDER_COMPONENT_H
#define SLIDER_COMPONENT_H

#include <stdbool.h>
#include <stddef.h>

#include "../averaged/friction_table.h"
#include "../base/memory.h"
#include "../base/refusal.h"
#include "../friction/bending_kernels.h"
#include "../friction/law.h"
#include "experiment.h"
#include "outputs.h"
#include "ramped_step.h"
#include "snapshot.h"

/* A slider-resonator. `now` is its complete state, the rest a cache of what follows from it: laws[present]
 * is the law of the present values if `prepared`, the other entry is for the law tried next; `ramped` is the last
 * step under inputs that vary.
 *
 * The tables take far more memory than the rest: each is NULL until a law needs it, comes from `memory`, and
 * stays. Laws point to them. */
typedef struct {
    Snapshot now;
    bool prepared;
    int present;
    Law laws[2];
    RampedStep ramped;
    Memory memory;
    FrictionTables *tables;
    BendingTables *bending;
    Theory theory;
} Component;

#include "component_functions.h"

/* Like component_step, but end at the first reversal, stick, release, lift-off or touchdown after the
 * start; `event` is then true, and the present time is that of the event. */
bool component_step_to_event(Component *component, double time, double step_size, bool *event,
                             Refusal *refusal);

/* Set the first derivatives of inputs by reference, per s: all of them or, if one is refused, none. A
 * derivative holds until it is set again, or until its input is set after a step without it. */
bool component_set_derivatives(Component *component, const unsigned *references,
                               const double *values, size_t count, Refusal *refusal);

/* Get the first derivatives of outputs by reference, per s: all or none; from initialization mode on. */
bool component_get_derivatives(Component *component, const unsigned *references, double *values,
                               size_t count, Refusal *refusal);

/* Event mode of FMI 3.0: values may be set, time stands still. */
bool component_enter_event_mode(Component *component, Refusal *refusal);
bool component_enter_step_mode(Component *component, Refusal *refusal);

#endif
