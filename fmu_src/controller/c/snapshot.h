/* The complete state of a controller, and its bytes: the same on every platform. */
#ifndef CONTROLLER_SNAPSHOT_H
#define CONTROLLER_SNAPSHOT_H

#include <stdbool.h>
#include <stddef.h>

#include "control.h"
#include "lifecycle.h"
#include "refusal.h"
#include "variables.h"

/* Times in s; `stop_time` is infinite where it is open. `values` are those that can be set, by
 * reference. `samples` counts those taken since `start_time`. */
typedef struct {
    Lifecycle lifecycle;
    double start_time, time, stop_time, samples;
    Control control;
    double values[SETTABLE_COUNT];
} Snapshot;

/* Number of bytes of any snapshot. */
size_t snapshot_size(void);

/* Writes snapshot_size() bytes, headed by the build and closed by their checksum. */
void snapshot_write(const Snapshot *snapshot, unsigned char *bytes);

/* Reads what snapshot_write wrote. Refuses bytes of another build and damaged ones; `snapshot` is
 * then undefined. */
bool snapshot_read(Snapshot *snapshot, const unsigned char *bytes, size_t size, Refusal *refusal);

#endif
