/* The complete state of a controller. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "../base/refusal.h"
#include "control.h"
#include "lifecycle.h"
#include "variables.h"

/* Times in s; an open `stop_time` is infinite. `values` are those that can be set, by reference. `samples` counts those
 * taken since `start_time`. No field is followed by padding: a serialised state has their bytes. */
typedef struct {
    double start_time, time, stop_time, samples;
    Control control;
    double values[SETTABLE_COUNT];
    Lifecycle lifecycle;
} Snapshot;
