/* A look at a motion on its way. */
#ifndef SLIDER_TRACE_H
#define SLIDER_TRACE_H

#include "state.h"

/* `see` gets the state and the position [m] at `first` [s] from the beginning of the motion on, and then every
 * `every` [s], `count` times in all, with the `index` of each. `seen` counts these. */
typedef struct {
    double first, every;
    int count, seen;
    void (*see)(void *observer, int index, const State *state, double position);
    void *observer;
} Trace;

#endif
