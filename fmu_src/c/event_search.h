/* The search for the first event of a motion: a reversal, stick, release, lift-off or touchdown. */
#ifndef SLIDER_EVENT_SEARCH_H
#define SLIDER_EVENT_SEARCH_H

#include <stdbool.h>

/* Events up to `after` [s] from the start are passed over, none if that is negative: an event at which
 * the motion begins is none of its own. If one is `found`, the motion ended there, `elapsed` + `carry` [s] from its start;
 * `carry` is what rounding takes from `elapsed`. */
typedef struct {
    double after;
    bool found;
    double elapsed, carry;
} EventSearch;

static inline EventSearch event_search(double after) {
    return (EventSearch){after, false, 0.0, 0.0};
}

#endif
