#include <math.h>

#include "../base/elementary.h"
#include "../base/number.h"
#include "../base/runge_kutta.h"
#include "slow_step.h"

/* Estimated error that is accepted, in tolerances; by how much that estimate, of the embedded method of order 4, exceeds the
 * error. */
#define STEP_TOLERANCE 3.0
#define OVERESTIMATE 5.0

/* The step that is expected to hold, over the time in which rates change, where all that the slow velocity still changes by
 * is the tolerance: what holds in most devices. */
#define EXPECTED_STEP 3.3

/* Largest drift of the load's phase [rad] in a step: an eighth of a beat, so that its stages see all phases. */
#define MAX_STEP_DRIFT (PI / 4.0)

/* Largest decay of the slow velocity in a period, over the share of friction: beyond, it is noise. */
#define MAX_DECAY 4.0

static bool rate_at(void *data, double n, double velocity, SlowRate *rate) {
    SlowPath *path = data;
    if (!evaluate(path, n, velocity)) {
        return false;
    }
    *rate = (SlowRate){path->last.rates.acceleration, path->last.rates.travel};
    return true;
}

double expected_step(const SlowPath *path) {
    const PeriodMap *map = path->manifold.map;
    double acceleration = fabs(path->here.rates.acceleration);
    double gain = fabs(path->here.rates.jerk) / acceleration;
    double change = acceleration / (gain * map->speed);
    return gain > 0.0 ? EXPECTED_STEP / gain * pow(map->tolerance / change, 1.0 / ORDER) : INFINITY;
}

bool embedded_step(SlowPath *path, double *h, PathStep *result) {
    const PeriodMap *map = path->manifold.map;
    const PathPoint *here = &path->here;
    SlowRate rate = {here->rates.acceleration, here->rates.travel};
    SlowPoint from = {here->n, here->velocity, 0.0, rate};
    double to_reach = reach_of_step(path) / fabs(rate.acceleration);
    double in_beat = MAX_STEP_DRIFT / fabs(drift_after(map, here->n));
    double allowed = STEP_TOLERANCE * map->tolerance * map->speed;
    SlowStep step;
    *h = floor(fmin(*h, fmin(in_beat, to_reach)));
    if (*h < SHORTEST_STEP || !runge_kutta_step(rate_at, path, &from, *h, &step) ||
        !isfinite(step.error)) {
        *h *= SHORTER;
        return false;
    }
    double gain = fmax(step.gain, -MAX_DECAY * map->share);
    double factor = gain < 0.0 ? exp(gain * *h) : 1.0;
    double error = step.error / OVERESTIMATE + *h * error_of_rates(path);
    *result = (PathStep){*h, step.to.travel, factor, error};
    *h *= step_growth(step.error, allowed);
    return step.error <= allowed;
}
