/* The slow manifold of the period map, and the slow rates on it.
 *
 * On the slow manifold the fast states follow the slow velocity smoothly: their differences of high order over the
 * periods vanish (Gear, Kaper, Kevrekidis, Zagaris 2005). */
#pragma once

#include "period_map.h"

/* Order of the differences that vanish: a sequence maps so many periods. */
enum { DIFFERENCES = 3 };

/* Largest number of sequences that one evaluation maps. */
enum { MAX_SEQUENCES = 6 };

/* How to find the manifold: until a correction of the fast states is at most `allowed`, over their scales. `maps`
 * counts periods. */
typedef struct {
    const PeriodMap *map;
    Budget *budget;
    int max_sequences;
    double allowed;
    int maps;
} Manifold;

/* Per period: the change of the slow velocity [m/s] (`acceleration`), of the position [m] (`travel`), of `acceleration`
 * (`jerk`) and of the `fast` states, and the number of reversals. `error` is the estimated error of
 * `acceleration`, `offset` the size of the first correction of the fast states, over their scales. */
typedef struct {
    double acceleration, travel, jerk;
    double fast[MAX_FAST], fast_rate[MAX_FAST];
    double reversals, error, offset;
    uint64_t itinerary;
} SlowRates;

/* The rates at the slow velocity V [m/s] and normal phase of a moment at the section, `begin` periods after the inputs
 * of the system began to grow. The fast states of the moment are a first guess; they are put on the manifold. `after`
 * is the moment a sequence later. Return false where the manifold is not found; the offset is infinite where there is
 * no motion to be mapped, and `after` then undefined. */
bool slow_rates(Manifold *manifold, double begin, Moment *moment, Moment *after, SlowRates *rates);
