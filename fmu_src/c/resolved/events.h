/* The loop over events: resolved motion under any friction law, leg by leg. */
#ifndef SLIDER_EVENTS_H
#define SLIDER_EVENTS_H

#include <stdbool.h>
#include <stdint.h>

#include "../base/refusal.h"
#include "../device/budget.h"
#include "../device/moment.h"
#include "../friction/law.h"

/* The search for the first event of a motion: a reversal, stick, release, lift-off or touchdown.
 *
 * A search ignores events up to `after` [s] from the start of the motion, so that it does not find the
 * event at which the motion begins; a negative `after` ignores none. If an event is `found` the motion ends
 * there, `elapsed` + `carry` [s] after its start; `carry` is the rounding error of `elapsed`. */
typedef struct {
    double after;
    bool found;
    double elapsed, carry;
} EventSearch;

static inline EventSearch event_search(double after) {
    return (EventSearch){after, false, 0.0, 0.0};
}

/* The last mode of an itinerary that has none yet. */
enum { NO_MODE = -2 };

/* Looks at a motion on its way, at regular times.
 *
 * `see` gets the moment at `first` [s] from the beginning of the motion on, and then every `every` [s], `count` times in all,
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

/* Advance by `duration` > 0 [s] from `moment` to `now`, another moment, under the inputs of the law, or to
 * the event that a `search` finds before; NULL searches for none. Refuses, with `now` undefined, where the
 * motion takes more legs than the budget has. Where numbers leave the range of floating point, entries of `now` are not
 * finite. */
bool events_advance(const Law *law, const Moment *moment, double duration, EventSearch *search,
                    Budget *budget, Moment *now, Refusal *refusal);

/* The same without a search, but with a `trace` that looks at the motion on its way, up to its end. */
bool events_trace(const Law *law, const Moment *moment, double duration, Trace *trace, Budget *budget,
                  Moment *now, Refusal *refusal);

#endif
