/* The search for the first event of a motion: a reversal, stick, release, lift-off or touchdown. */
#ifndef SLIDER_EVENT_SEARCH_H
#define SLIDER_EVENT_SEARCH_H

#include <stdbool.h>

/* A search ignores events up to `after` [s] from the start of the motion, so that it does not find the
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

#endif
