/* The component between numerics and FMI: values by reference, lifecycle, steps. */
#pragma once

#include "component_system.h"
#include "experiment.h"
#include "outputs.h"
#include "snapshot.h"

/* A slider-resonator: its complete state, and caches of what follows from it. */
typedef struct {
    Snapshot now;  /* the complete state */
    bool prepared; /* whether a system of the present values is prepared */
    System system; /* that system */
    Tables tables; /* of friction, to which systems point */
    Theory theory; /* the last predictions */
} Component;

#include "component_functions.h"

/* Like component_step, but end at the first reversal, stick, release, lift-off or touchdown after the start; `event` is
 * then true, and the present time is that of the event. */
bool component_step_to_event(Component *component, double time, double step_size, bool *event, Refusal *refusal);

/* Set the first derivatives of inputs by reference, per s: all of them or, if one is refused, none. A derivative holds
 * until it is set again, or until its input is set after a step without it. */
bool component_set_derivatives(Component *component, const unsigned *references, const double *values, size_t count,
                               Refusal *refusal);

/* Get the first derivatives of outputs by reference, per s: all or none; from initialization mode on. */
bool component_get_derivatives(Component *component, const unsigned *references, double *values, size_t count,
                               Refusal *refusal);

/* Event mode of FMI 3.0: values may be set, time stands still. */
bool component_enter_event_mode(Component *component, Refusal *refusal);
bool component_enter_step_mode(Component *component, Refusal *refusal);
