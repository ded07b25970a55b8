/* The end of averaged motion that is steady but for a last approach, without following it. */
#ifndef SLIDER_SETTLING_H
#define SLIDER_SETTLING_H

#include <stdbool.h>

#include "dormand_prince.h"

/* Takes `now` to time `end` [s] if its velocity has come close to one at which forces balance, by
 * the measure of the `fast` velocity [m/s], and would be drawn into it well before `end`; answers
 * whether so. The acceleration must not depend on time. */
bool settle(AccelerationFunction acceleration, const void *motion, double fast, double end,
            Passage *now);

#endif
