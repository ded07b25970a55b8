#include "slow_path.h"

#include "../base/elementary.h"

void know_last(SlowPath *path) {
    const Visited *last = &path->last;
    double values[FUNCTIONS] = {last->rates.acceleration, last->rates.travel};
    for (int i = 0; i < MAX_FAST; i++) {
        values[FAST + i] = last->rates.fast[i];
    }
    interpolant_add(&path->known, last->velocity, values);
}

void begin_step(SlowPath *path) {
    path->here = path->last;
    path->known.count = 0;
    know_last(path);
}

/* Fast states at a point: interpolated, or along the tangent of the nearer one of two points in time. */
static void guess_fast(const SlowPath *path, double n, double velocity, double fast[MAX_FAST]) {
    const Visited *here = &path->here, *last = &path->last;
    if (path->known.count > 1) {
        double values[FUNCTIONS];
        interpolant_at(&path->known, velocity, FUNCTIONS, values);
        for (int i = 0; i < MAX_FAST; i++) {
            fast[i] = values[FAST + i];
        }
        return;
    }
    const Visited *near = fabs(n - last->n) < fabs(n - here->n) ? last : here;
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

bool visit(SlowPath *path, double n, double velocity) {
    const PeriodMap *map = path->manifold.map;
    Visited visited = {.n = n, .velocity = velocity, .landing = path->here.landing};
    double fast[MAX_FAST];
    visited.landing.stops = path->last.after.stops;
    guess_fast(path, n, velocity, fast);
    moment_place(map, velocity, fast, psi_after(map, path->psi, n), &visited.landing);
    if (!slow_rates(&path->manifold, n, &visited.landing, &visited.after,
                    &visited.rates) ||
        !are_exact(map, &visited.rates) ||
        visited.rates.itinerary != path->here.rates.itinerary) {
        return false;
    }
    path->last = visited;
    return true;
}

double reach_of_step(const SlowPath *path) {
    return 0.5 * fabs(fabs(path->here.velocity) - path->manifold.map->speed);
}

double error_of_rates(const SlowPath *path) {
    return fmax(path->here.rates.error, path->last.rates.error);
}
