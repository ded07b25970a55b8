/* The complete state of a component. */
#pragma once

#include "../device/moment.h"
#include "input_derivatives.h"
#include "variables.h"

/* A serialised state has the bytes of these fields: none is followed by padding, so that they are the same on every
 * platform. */
typedef struct {
    Moment moment;                              /* defined once initialization has ended */
    double time;                                /* present time [s] */
    double time_carry;                          /* rounding error of `time` [s] at a located event */
    double stop_time;                           /* end of the experiment [s], infinite if it is open */
    double last_event_time;                     /* time of the last event [s] */
    InputDerivative derivatives[VARYING_COUNT]; /* of the inputs, per s */
    double values[SETTABLE_COUNT];              /* of the variables that can be set, by reference */
    Lifecycle lifecycle;                        /* the state of FMI */
} Snapshot;
