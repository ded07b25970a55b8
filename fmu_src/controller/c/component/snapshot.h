/* The complete state of a controller, and its bytes: the same on every platform. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "../base/refusal.h"
#include "control.h"
#include "lifecycle.h"
#include "variables.h"

/* Times in s; an open `stop_time` is infinite. `values` are those that can be set, by reference. `samples` counts those
 * taken since `start_time`. */
typedef struct {
    Lifecycle lifecycle;
    double start_time, time, stop_time, samples;
    Control control;
    double values[SETTABLE_COUNT];
} Snapshot;

/* Number of bytes of any snapshot. */
size_t snapshot_size(void);

/* Write snapshot_size() bytes: build, numbers, checksum. */
void snapshot_write(const Snapshot *snapshot, unsigned char *bytes);

/* Read what snapshot_write wrote. Refuse bytes of another build, damaged ones, and numbers that no controller can have;
 * `snapshot` is then undefined. */
bool snapshot_read(Snapshot *snapshot, const unsigned char *bytes, size_t size, Refusal *refusal);
