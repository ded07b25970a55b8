/* The complete state of a component and its bytes, which are the same on every platform. */
#pragma once

#include "../device/moment.h"
#include "input_derivatives.h"
#include "variables.h"

typedef struct {
    Lifecycle lifecycle;                        /* the state of FMI */
    double time;                                /* present time [s] */
    double time_carry;                          /* rounding error of `time` [s] at a located event */
    double stop_time;                           /* end of the experiment [s], infinite if it is open */
    double last_event_time;                     /* time of the last event [s] */
    double values[SETTABLE_COUNT];              /* of the variables that can be set, by reference */
    InputDerivative derivatives[VARYING_COUNT]; /* of the inputs, per s */
    Moment moment;                              /* defined once initialization has ended */
} Snapshot;

/* Number of bytes of any snapshot. */
size_t snapshot_size(void);

/* Write snapshot_size() bytes: format, build, numbers, checksum. */
void snapshot_write(const Snapshot *snapshot, unsigned char *bytes);

/* Read what snapshot_write wrote. Refuse bytes of another build, damaged ones, and numbers that no component can have;
 * `snapshot` is then undefined. */
bool snapshot_read(Snapshot *snapshot, const unsigned char *bytes, size_t size, Refusal *refusal);
