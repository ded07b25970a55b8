/* The loop over events: resolved motion under any friction law, leg by leg. */
#ifndef SLIDER_EVENTS_H
#define SLIDER_EVENTS_H

#include <stdbool.h>

#include "law.h"
#include "moment.h"
#include "refusal.h"

/* The moment `duration` > 0 [s] later, inputs held. Refuses, with `after` undefined, where time
 * does not get on; `after` may be `moment`. Where numbers leave the range of floating point,
 * entries of `after` are not finite. */
bool events_advance(const Law *law, const Moment *moment, double duration, Moment *after,
                    Refusal *refusal);

#endif
