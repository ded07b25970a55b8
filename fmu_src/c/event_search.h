/* The search for the first event of a motion: a reversal, stick, release, lift-off or touchdown. */
#ifndef SLIDER_EVENT_SEARCH_H
#define SLIDER_EVENT_SEARCH_H

#include <stdbool.h>

/* Events sooner than `from` > 0 [s] after the start are passed over: an event at which the motion
 * begins is none of its own. If one is `found`, the motion ended there, `elapsed` + `carry` [s] after
 * its start; `carry` is what rounding takes from `elapsed`. */
typedef struct {
    double from;
    bool found;
    double elapsed, carry;
} EventSearch;

static inline EventSearch event_search(double from) {
    return (EventSearch){from, false, 0.0, 0.0};
}

#endif
