/* The loop over events: resolved motion under any friction law, leg by leg. */
#ifndef SLIDER_EVENTS_H
#define SLIDER_EVENTS_H

#include <stdbool.h>

#include "../base/refusal.h"
#include "../device/budget.h"
#include "../device/moment.h"
#include "../friction/law.h"
#include "event_search.h"
#include "trace.h"

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
