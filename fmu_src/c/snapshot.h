/* The complete state of a component, and its bytes: the same on every platform, so that a state can
 * be carried to another process or machine. */
#ifndef SLIDER_SNAPSHOT_H
#define SLIDER_SNAPSHOT_H

#include <stdbool.h>
#include <stddef.h>

#include "lifecycle.h"
#include "moment.h"
#include "refusal.h"
#include "variables.h"

/* Times in s; `stop_time` is infinite where it is open. `values` are those that can be set, by
 * reference. `moment` counts once `moving`, from the end of initialization on. */
typedef struct {
    Lifecycle lifecycle;
    double time, stop_time, last_event_time;
    double values[SETTABLE_COUNT];
    bool moving;
    Moment moment;
} Snapshot;

/* Number of bytes of any snapshot. */
size_t snapshot_size(void);

/* Writes snapshot_size() bytes, headed by format and build and closed by their checksum. */
void snapshot_write(const Snapshot *snapshot, unsigned char *bytes);

/* Reads what snapshot_write wrote. Refuses bytes of another build, damaged ones, and numbers that
 * no component can have; `snapshot` is then undefined. */
bool snapshot_read(Snapshot *snapshot, const unsigned char *bytes, size_t size, Refusal *refusal);

#endif
