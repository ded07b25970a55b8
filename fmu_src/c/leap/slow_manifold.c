#include "slow_manifold.h"

/* Largest change of the slow velocity in a period, over itself and the share of friction. */
#define MAX_RATE 4.0

/* Largest factor by which corrections shrink. */
#define SHRINKS 0.5

/* Replace the sections of a sequence by their differences of all orders. */
static void take_differences(SectionState *sections) {
    for (int j = 1; j <= DIFFERENCES; j++) {
        for (int i = DIFFERENCES; i >= j; i--) {
            for (int k = 0; k < NUMBERS; k++) {
                sections[i].at[k] -= sections[i - 1].at[k];
            }
        }
    }
}

/* Rate per period of number `k` of a smooth sequence: the logarithm of the shift operator. */
static double rate_of(const SectionState *differences, int k) {
    double rate = 0.0;
    for (int j = DIFFERENCES; j >= 1; j--) {
        rate += (j % 2 == 1 ? differences[j].at[k] : -differences[j].at[k]) / j;
    }
    return rate;
}

/* The estimated ratio of differences to those of the order before: the larger of the last two ratios of the velocity,
 * as one may be small by accident, but at most what slow motion and drift allow. */
static double ratio_of(const PeriodMap *map, const SectionState *differences) {
    double first = fabs(differences[1].at[SLOW_VELOCITY]), second = fabs(differences[2].at[SLOW_VELOCITY]);
    double third = fabs(differences[3].at[SLOW_VELOCITY]);
    double larger = fmax(third / fmax(second, SMALLEST), second / fmax(first, SMALLEST));
    return fmin(MAX_RATE * map->share + fabs(map->drift), larger);
}

/* Size of the next difference of number `k` after that of an order, if differences shrink by a `ratio`. */
static double next_difference(const SectionState *differences, int order, double ratio, int k) {
    double last = fabs(differences[order].at[k]), before = fabs(differences[order - 1].at[k]);
    return ratio * fmax(last, ratio * before);
}

/* The correction of the fast states: their last differences must vanish. On the manifold these do not quite: `missing`
 * is the size of the fast states' error by that, estimated from lower orders. */
static void correction_of(const PeriodMap *map, const SectionState *differences, double ratio,
                          double correction[MAX_FAST], double *missing) {
    double beyond[MAX_FAST];
    for (int i = 0; i < MAX_FAST; i++) {
        correction[i] = -differences[DIFFERENCES].at[FAST_STATES + i];
        beyond[i] = next_difference(differences, DIFFERENCES - 1, ratio, FAST_STATES + i);
    }
    apply_resolvent(map, DIFFERENCES, correction);
    apply_resolvent(map, DIFFERENCES, beyond);
    *missing = fast_size(map, beyond);
}

/* The rates of a sequence of sections. */
static SlowRates rates_of(const SectionState *differences, double ratio, const double step[MAX_FAST]) {
    double second = differences[2].at[SLOW_VELOCITY], third = differences[3].at[SLOW_VELOCITY];
    SlowRates rates = {.acceleration = rate_of(differences, SLOW_VELOCITY),
                       .travel = rate_of(differences, SLOW_POSITION),
                       .jerk = second - third};
    for (int i = 0; i < MAX_FAST; i++) {
        rates.fast_rate[i] = rate_of(differences, FAST_STATES + i);
        rates.fast[i] = differences[0].at[FAST_STATES + i] + step[i];
    }
    rates.error = next_difference(differences, DIFFERENCES, ratio, SLOW_VELOCITY) / (DIFFERENCES + 1);
    return rates;
}

bool slow_rates(Manifold *manifold, double begin, Moment *moment, Moment *after, SlowRates *rates) {
    const PeriodMap *map = manifold->map;
    double velocity = slow_velocity(&map->system, &moment->state, moment->theta), offset = 0.0, before = INFINITY;
    for (int i = 0; i < manifold->max_sequences; i++) {
        SectionState sections[DIFFERENCES + 1];
        double missing, step[MAX_FAST];
        uint64_t itinerary;
        *after = *moment;
        manifold->maps += DIFFERENCES;
        if (!map_periods(map, begin, DIFFERENCES, after, manifold->budget, sections, &itinerary)) {
            rates->offset = INFINITY;
            return false;
        }
        SectionState *last = &sections[DIFFERENCES];
        double reversals = last->at[REVERSALS] - last[-1].at[REVERSALS];
        take_differences(sections);
        double ratio = ratio_of(map, sections);
        correction_of(map, sections, ratio, step, &missing);
        double size = fast_size(map, step);
        rates->offset = offset = i == 0 ? size : offset;
        if (size <= manifold->allowed) {
            *rates = rates_of(sections, ratio, step);
            rates->reversals = reversals;
            rates->error += map->share * map->speed * (missing + size);
            rates->offset = offset;
            rates->itinerary = itinerary;
            return true;
        }
        if (!(size <= SHRINKS * before)) {
            return false;
        }
        before = size;
        double fast[MAX_FAST];
        for (int j = 0; j < MAX_FAST; j++) {
            fast[j] = sections[0].at[FAST_STATES + j] + step[j];
        }
        moment_place(map, velocity, fast, moment->psi, moment);
    }
    return false;
}
