#include "slow_manifold.h"

#include <math.h>
#include <stddef.h>

#include "../device/device.h"

/* Largest change of the slow velocity in a period, over itself and the share of friction. */
#define MAX_RATE 4.0

/* Largest factor by which corrections shrink. */
#define SHRINKS 0.5

/* Differences of order 0 to `order` of a number of order + 1 visits, at `offset` in these. */
static void differences_of(const Visit *visits, size_t offset, int order, double *differences) {
    for (int j = 0; j <= order; j++) {
        differences[j] = *(const double *)((const char *)&visits[j] + offset);
    }
    for (int j = 1; j <= order; j++) {
        for (int i = order; i >= j; i--) {
            differences[i] -= differences[i - 1];
        }
    }
}

/* Where a fast state is in a visit. */
static size_t offset_of_fast(int i) {
    return offsetof(Visit, fast) + (size_t)i * sizeof(double);
}

/* Rate per period of a smooth sequence, from its differences: the logarithm of the shift operator. */
static double rate_of(const double *differences, int order) {
    double rate = 0.0;
    for (int j = order; j >= 1; j--) {
        rate += (j % 2 == 1 ? differences[j] : -differences[j]) / j;
    }
    return rate;
}

/* The factor by which differences of an order shrink to the next: the larger of the last two, as either may happen to be next
 * to zero, but not more than the slow motion and the drift allow. */
static double ratio_of(const PeriodMap *map, const double *differences, int order) {
    double last = fabs(differences[order] / differences[order - 1]);
    double before = fabs(differences[order - 1] / differences[order - 2]);
    return fmin(MAX_RATE * map->share + fabs(map->drift), fmax(last, before));
}

/* Size of the next difference after that of an order, if differences shrink by a `ratio`. */
static double next_difference(const double *differences, int order, double ratio) {
    return ratio * fmax(fabs(differences[order]), ratio * fabs(differences[order - 1]));
}

/* The correction of the fast states: their differences of the manifold's order must vanish. `missing` is the size of what
 * those differences are on the manifold, estimated from lower orders, as a change of the fast states. */
static void correction_of(const Manifold *manifold, const Visit *visits, double ratio,
                          double correction[MAX_FAST], double *missing) {
    const PeriodMap *map = manifold->map;
    int order = manifold->order;
    double beyond[MAX_FAST];
    for (int i = 0; i < MAX_FAST; i++) {
        double differences[MAX_ORDER + 1];
        differences_of(visits, offset_of_fast(i), order, differences);
        correction[i] = -differences[order];
        beyond[i] = next_difference(differences, order - 1, ratio);
    }
    apply_resolvent(map, order, correction);
    apply_resolvent(map, order, beyond);
    *missing = fast_size(map, beyond);
}

/* What a free swing of a size, over the scale of the resonator's displacement, adds at most to the mean velocity of a turn
 * [m/s]: it is of the other sign half a turn later. */
static double mean_velocity_of(const PeriodMap *map, double size) {
    const Plant *plant = &map->law.held.plant;
    return plant->mass_fraction * size * map->scale[0] * plant->drive_frequency / PI;
}

/* The rates of a sequence of visits. */
static SlowRates rates_of(const Manifold *manifold, const Visit *visits, double ratio,
                          const double step[MAX_FAST]) {
    int order = manifold->order;
    double velocities[MAX_ORDER + 1], positions[MAX_ORDER + 1];
    differences_of(visits, offsetof(Visit, velocity), order, velocities);
    differences_of(visits, offsetof(Visit, position), order, positions);
    SlowRates rates = {.acceleration = rate_of(velocities, order),
                       .travel = rate_of(positions, order),
                       .jerk = velocities[2] - velocities[3]};
    for (int i = 0; i < MAX_FAST; i++) {
        double differences[MAX_ORDER + 1];
        differences_of(visits, offset_of_fast(i), order, differences);
        rates.fast_rate[i] = rate_of(differences, order);
        rates.fast[i] = visits[0].fast[i] + step[i];
    }
    rates.reversals = visits[order].reversals - visits[order - 1].reversals;
    rates.sticks = visits[order].sticks - visits[order - 1].sticks;
    rates.error = next_difference(velocities, order, ratio) / (order + 1);
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
        double velocities[MAX_ORDER + 1];
        differences_of(visits, offsetof(Visit, velocity), manifold->order, velocities);
        double ratio = ratio_of(map, velocities, manifold->order);
        correction_of(manifold, visits, ratio, step, &missing);
        double size = fast_size(map, step);
        offset = i == 0 ? size : offset;
        if (size <= manifold->allowed) {
            *rates = rates_of(manifold, visits, ratio, step);
            rates->error += map->share * map->speed * (missing + size);
            rates->swing_error = mean_velocity_of(map, missing + size);
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
