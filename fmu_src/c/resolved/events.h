/* The loop over events: resolved motion under any friction law, segment by segment. */
#pragma once

#include <stdint.h>

#include "../device/budget.h"
#include "../friction/system.h"

/* The search for the first event of a motion: a reversal, stick, release, lift-off or touchdown.
 *
 * A search ignores events up to `after` [s] from the start of the motion, so that it does not find the event at which
 * the motion begins; a negative `after` ignores none. If an event is `found` the motion ends there, `elapsed` + `carry`
 * [s] after its start; `carry` is the rounding error of `elapsed`. */
typedef struct {
    double after;
    bool found;
    double elapsed, carry;
} EventSearch;

/* A hash of the contact modes that follow each other: motions with one itinerary depend smoothly on where they begin.
 * `last` is the last of the modes. A motion that has one counts in the means of periods only if it `counts_means`. */
typedef struct {
    uint64_t hash;
    int last;
    bool counts_means;
} Itinerary;

/* The last mode of an itinerary that has none yet. */
enum { NO_MODE = -2 };

/* Advance by `duration` > 0 [s] from `moment` to `now`, another moment, under the inputs of the system, or to the event
 * that a `search` finds before; NULL searches for none. Contact modes are added to an `itinerary`, unless that is NULL.
 * Refuses, with `now` undefined, where the motion takes more segments than the budget has. Where numbers leave the
 * range of floating point, entries of `now` are not finite. */
bool events_advance(const System *system, const Moment *moment, double duration, EventSearch *search,
                    Itinerary *itinerary, Budget *budget, Moment *now, Refusal *refusal);
