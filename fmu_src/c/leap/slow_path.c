#include "slow_path.h"

#include <string.h>

/* Number of points of which the one in the widest gap is taken. */
enum { CANDIDATES = 24 };

void interpolate_last(SlowPath *path) {
    const PathPoint *last = &path->last;
    Interpolant *polynomials = &path->interpolant;
    int count = polynomials->count++;
    double *row = polynomials->difference[count];
    row[ACCELERATION] = last->rates.acceleration;
    row[TRAVEL] = last->rates.travel;
    memcpy(row + FAST, last->rates.fast, sizeof last->rates.fast);
    for (int i = 0; i < count; i++) {
        double distance = last->velocity - polynomials->point[i];
        for (int k = 0; k < FUNCTIONS; k++) {
            row[k] = (row[k] - polynomials->difference[i][k]) / distance;
        }
    }
    polynomials->point[count] = last->velocity;
}

void interpolant_at(const Interpolant *polynomials, double x, int functions, double values[FUNCTIONS]) {
    for (int k = 0; k < functions; k++) {
        values[k] = 0.0;
    }
    for (int i = polynomials->count - 1; i >= 0; i--) {
        double distance = x - polynomials->point[i];
        for (int k = 0; k < functions; k++) {
            values[k] = polynomials->difference[i][k] + distance * values[k];
        }
    }
}

double interpolant_gap(const Interpolant *polynomials, double from, double to) {
    double widest = -1.0, found = from;
    for (int j = 1; j < CANDIDATES; j++) {
        double x = from + (to - from) * j / CANDIDATES, product = 1.0;
        for (int i = 0; i < polynomials->count; i++) {
            product *= fabs((x - polynomials->point[i]) / (to - from));
        }
        if (product > widest) {
            widest = product;
            found = x;
        }
    }
    return found;
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
        memcpy(fast, values + FAST, MAX_FAST * sizeof fast[0]);
        return;
    }
    const PathPoint *near = fabs(n - last->n) < fabs(n - here->n) ? last : here;
    bool moves = fabs(near->rates.acceleration) > near->rates.error;
    double periods = moves && !path->varies ? (velocity - near->velocity) / near->rates.acceleration : n - near->n;
    for (int i = 0; i < MAX_FAST; i++) {
        fast[i] = near->rates.fast[i] + periods * near->rates.fast_rate[i];
    }
}

bool are_exact(const PeriodMap *map, const SlowRates *rates) {
    return rates->error <= map->share * map->tolerance * map->speed;
}

/* Where to expect stops at a slow velocity [m/s]: from the last ones they move with the angles at which the vibration
 * alone would turn the direction of sliding. */
static Stops stops_at(const SlowPath *path, double velocity) {
    double speed = path->manifold.map->speed;
    double turned = turning_at(velocity, speed) - turning_at(path->last.velocity, speed);
    Stops stops = path->last.after.stops;
    stops.backward.theta += turned;
    stops.forward.theta -= turned;
    return stops;
}

bool evaluate(SlowPath *path, double n, double velocity) {
    const PeriodMap *map = path->manifold.map;
    PathPoint point = {.n = n, .velocity = velocity, .moment = path->here.moment};
    double fast[MAX_FAST];
    point.moment.stops = stops_at(path, velocity);
    guess_fast(path, n, velocity, fast);
    moment_place(map, velocity, fast, psi_after(map, path->psi, n), &point.moment);
    if (!slow_rates(&path->manifold, n, &point.moment, &point.after, &point.rates) || !are_exact(map, &point.rates) ||
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
