#include "slow_manifold.h"

#include <math.h>
#include <stddef.h>

#include "../device/state.h"

/* Largest factor by which corrections shrink. */
#define SHRINKS 0.5

/* Differences of order 0 to `order` of a sequence of order + 1 numbers, in its place. */
static void take_differences(double *numbers, int order) {
    for (int j = 1; j <= order; j++) {
        for (int i = order; i >= j; i--) {
            numbers[i] -= numbers[i - 1];
        }
    }
}

/* Rate per period of a smooth sequence, from its differences: the logarithm of the shift operator. */
static double rate_of(const double *differences, int order) {
    double rate = 0.0;
    for (int j = order; j >= 1; j--) {
        rate += (j % 2 == 1 ? differences[j] : -differences[j]) / j;
    }
    return rate;
}

/* Size of the next term after a term `last`, if terms shrink as they did from `before` to `last`. */
static double next_term(double before, double last) {
    before = fabs(before);
    last = fabs(last);
    return before > last ? last * (last / before) : last;
}

/* The correction of the fast states: their differences of the manifold's order must vanish. `missing` is the size of what
 * those differences are on the manifold, estimated from lower orders, as a change of the fast states. */
static void correction_of(const Manifold *manifold, const Visit *visits,
                          double correction[MAX_FAST], double *missing) {
    const PeriodMap *map = manifold->map;
    int order = manifold->order;
    double beyond[MAX_FAST];
    for (int i = 0; i < MAX_FAST; i++) {
        double numbers[MAX_ORDER + 1];
        for (int j = 0; j <= order; j++) {
            numbers[j] = visits[j].fast[i];
        }
        take_differences(numbers, order);
        correction[i] = -numbers[order];
        beyond[i] = next_term(numbers[order - 2], numbers[order - 1]);
    }
    apply_resolvent(map, order, correction);
    apply_resolvent(map, order, beyond);
    *missing = fast_size(map, beyond);
}

/* The rates of a sequence of visits. */
static SlowRates rates_of(const Manifold *manifold, const Visit *visits,
                          const double step[MAX_FAST]) {
    int order = manifold->order;
    double velocities[MAX_ORDER + 1], positions[MAX_ORDER + 1];
    for (int j = 0; j <= order; j++) {
        velocities[j] = visits[j].velocity;
        positions[j] = visits[j].position - visits[0].position;
    }
    take_differences(velocities, order);
    take_differences(positions, order);
    SlowRates rates = {.acceleration = rate_of(velocities, order),
                       .travel = rate_of(positions, order),
                       .jerk = velocities[2] - velocities[3]};
    for (int i = 0; i < MAX_FAST; i++) {
        double numbers[MAX_ORDER + 1];
        for (int j = 0; j <= order; j++) {
            numbers[j] = visits[j].fast[i];
        }
        take_differences(numbers, order);
        rates.fast_rate[i] = rate_of(numbers, order);
        rates.fast[i] = visits[0].fast[i] + step[i];
    }
    rates.reversals = visits[order].reversals - visits[order - 1].reversals;
    rates.sticks = visits[order].sticks - visits[order - 1].sticks;
    rates.error = next_term(velocities[order - 1], velocities[order]) / (order + 1);
    return rates;
}

/* Broyden's method with the closed form as first Jacobian: turns the correction after `count` earlier `steps`
 * into the next step. */
static void improve(const PeriodMap *map, double steps[][MAX_FAST], int count) {
    double *step = steps[count];
    for (int j = 0; j < count; j++) {
        const double *earlier = steps[j], *next = steps[j + 1];
        double product = 0.0, square = 0.0;
        for (int i = 0; i < map->fast_count; i++) {
            double scale = map->scale[i];
            product += earlier[i] / scale * (step[i] / scale);
            square += earlier[i] / scale * (earlier[i] / scale);
        }
        double share = square > 0.0 ? product / square : 0.0;
        for (int i = 0; i < map->fast_count; i++) {
            step[i] = j + 1 < count ? step[i] + share * next[i] : step[i] / (1.0 - share);
        }
    }
}

bool slow_rates(Manifold *manifold, double begin, Moment *moment, Moment *after,
                SlowRates *rates) {
    const PeriodMap *map = manifold->map;
    double velocity = momentum_velocity(map, moment), offset = 0.0, before = INFINITY;
    double steps[MAX_SEQUENCES][MAX_FAST];
    for (int i = 0; i < manifold->max_sequences; i++) {
        Visit visits[MAX_ORDER + 1];
        double missing, *step = steps[i];
        uint64_t itinerary;
        *after = *moment;
        manifold->maps += manifold->order;
        if (!map_periods(map, begin, manifold->order, after, manifold->budget, visits,
                         &itinerary)) {
            rates->offset = INFINITY;
            return false;
        }
        correction_of(manifold, visits, step, &missing);
        double size = fast_size(map, step);
        offset = i == 0 ? size : offset;
        if (size <= manifold->allowed) {
            *rates = rates_of(manifold, visits, step);
            rates->error += map->share * map->speed * (missing + size);
            rates->offset = offset;
            rates->itinerary = itinerary;
            return true;
        }
        if (!(size <= SHRINKS * before)) {
            rates->offset = offset;
            return false;
        }
        before = size;
        improve(map, steps, i);
        double fast[MAX_FAST];
        for (int j = 0; j < MAX_FAST; j++) {
            fast[j] = visits[0].fast[j] + step[j];
        }
        moment_place(map, velocity, fast, moment->psi, moment);
    }
    rates->offset = offset;
    return false;
}
