/* A leap: the slow motion over many periods, from the period map alone. */
#pragma once

#include "slow_manifold.h"

/* How a leap ended: over all periods or some of them; or at once, as the fast states were not on the slow manifold, or
 * as nothing would be gained. */
typedef enum { LEAPT, NOT_ON_MANIFOLD, NO_GAIN } LeapOutcome;

/* `periods` that were passed, resolved ones included, and the number of periods that were mapped in vain; `wait`, the
 * number of periods until the fast states are on the manifold. */
typedef struct {
    LeapOutcome outcome;
    double periods, wait;
    int in_vain;
} Leap;

/* Leap from a moment at the section over at most `longest` periods; inputs may grow. `after` is then the moment a few
 * resolved periods behind the landing. Its `leap_error` has grown by the estimated error of the slow velocity, of which
 * the tolerance of the map is allowed. */
Leap leap(const PeriodMap *map, const Moment *moment, double longest, Budget *budget, Moment *after);
