/* Looks at a motion on its way, at regular times. */
#ifndef SLIDER_TRACE_H
#define SLIDER_TRACE_H

#include <stdint.h>

#include "../device/moment.h"

/* The last mode of an itinerary that has none yet. */
enum { NO_MODE = -2 };

/* `see` gets the moment at `first` [s] from the beginning of the motion on, and then every `every` [s], `count` times in all,
 * with the `index` of each. `seen` counts these. Of the moment, state, position, bristle and counts are set.
 *
 * `itinerary` is a hash of the contact modes that follow each other: motions with one itinerary depend smoothly on where
 * they begin. `mode` is the last of them. */
typedef struct {
    double first, every;
    int count, seen;
    void (*see)(void *observer, int index, const Moment *moment);
    void *observer;
    uint64_t itinerary;
    int mode;
} Trace;

/* Add a contact mode to the itinerary, unless it is the last one. */
static inline void trace_mode(Trace *trace, int mode) {
    if (mode != trace->mode) {
        trace->itinerary = (trace->itinerary ^ (uint64_t)(mode + 2)) * UINT64_C(0x100000001b3);
        trace->mode = mode;
    }
}

#endif
