#include "slow_path.h"

#include "../base/elementary.h"

void interpolate_last(SlowPath *path) {
    const PathPoint *last = &path->last;
    double values[FUNCTIONS] = {last->rates.acceleration, last->rates.travel};
    for (int i = 0; i < MAX_FAST; i++) {
        values[FAST + i] = last->rates.fast[i];
    }
    interpolant_add(&path->interpolant, last->velocity, values);
}

void begin_step(SlowPath *path) {
    path->here = path->last;
    path->interpolant.count = 0;
    interpolate_last(path);
}

/* Fast states at a point: interpolated, or along the tangent of the nearer one of two points in time. */
static void guess_fast(const SlowPath *path, double n, double velocity, double fast[MAX_FAST]) {
    const PathPoint *here = &path->here, *last = &path->last;
    if (path->interpolant.count > 1) {
        double values[FUNCTIONS];
        interpolant_at(&path->interpolant, velocity, FUNCTIONS, values);
        for (int i = 0; i < MAX_FAST; i++) {
            fast[i] = values[FAST + i];
        }
        return;
    }
    const PathPoint *near = fabs(n - last->n) < fabs(n - here->n) ? last : here;
    bool moves = fabs(near->rates.acceleration) > near->rates.error;
    double periods = moves && !path->varies
                         ? (velocity - near->velocity) / near->rates.acceleration
                         : n - near->n;
    for (int i = 0; i < MAX_FAST; i++) {
        fast[i] = near->rates.fast[i] + periods * near->rates.fast_rate[i];
    }
}

bool are_exact(const PeriodMap *map, const SlowRates *rates) {
    return rates->error <= map->share * map->tolerance * map->speed;
}

bool evaluate(SlowPath *path, double n, double velocity) {
    const PeriodMap *map = path->manifold.map;
    PathPoint point = {.n = n, .velocity = velocity, .moment = path->here.moment};
    double fast[MAX_FAST];
    point.moment.stops = path->last.after.stops;
    guess_fast(path, n, velocity, fast);
    moment_place(map, velocity, fast, psi_after(map, path->psi, n), &point.moment);
    if (!slow_rates(&path->manifold, n, &point.moment, &point.after,
                    &point.rates) ||
        !are_exact(map, &point.rates) ||
        point.rates.itinerary != path->here.rates.itinerary) {
        return false;
    }
    path->last = point;
    return true;
}

double reach_of_step(const SlowPath *path) {
    return 0.5 * fabs(fabs(path->here.velocity) - path->manifold.map->speed);
}

double error_of_rates(const SlowPath *path) {
    return fmax(path->here.rates.error, path->last.rates.error);
}
