/* The complete state of a component and its bytes, which are the same on every platform. */
#ifndef SLIDER_SNAPSHOT_H
#define SLIDER_SNAPSHOT_H

#include <stdbool.h>
#include <stddef.h>

#include "input_derivatives.h"
#include "lifecycle.h"
#include "moment.h"
#include "refusal.h"
#include "variables.h"

/* Times in s; an open `stop_time` is infinite. `time_carry` is the rounding error of `time` at a located
 * event. `values` are those of the variables that can be set, by reference.
 * `moment` is defined while `moving`, that is from the end of initialization on. */
typedef struct {
    Lifecycle lifecycle;
    double time, time_carry, stop_time, last_event_time;
    double values[SETTABLE_COUNT];
    InputDerivative derivatives[INPUT_COUNT];
    bool moving;
    Moment moment;
} Snapshot;

/* Number of bytes of any snapshot. */
size_t snapshot_size(void);

/* Write snapshot_size() bytes: format, build, numbers, checksum. */
void snapshot_write(const Snapshot *snapshot, unsigned char *bytes);

/* Read what snapshot_write wrote. Refuse bytes of another build, damaged ones, and numbers that no
 * component can have; `snapshot` is then undefined. */
bool snapshot_read(Snapshot *snapshot, const unsigned char *bytes, size_t size, Refusal *refusal);

#endif
