#include "slow_step.h"

#include "../base/elementary.h"
#include "../base/runge_kutta.h"

/* Factors by which a step becomes shorter that fails, and longer behind one that does not, if its error tells
 * nothing. */
#define SHORTER 0.5
#define LONGER 2.0

/* Share of the allowed error: for a velocity that hardly changes, so that no other point is evaluated, and for the
 * integration of interpolated rates. */
#define SMALL_SHARE 0.1

/* Rate of the slow velocity over v_q that is rounding. */
#define ROUNDING (4.0 * EPSILON)

/* Factor by which one more point of the interpolant is expected to reduce the error of the landing. Measured: 1/600 to
 * 1/16, in steps that keep a tolerance of 1e-6. */
#define IMPROVED (1.0 / 100.0)

/* Largest distance of a cubic from a chord, over its length and the difference of the slopes of both at one end. */
#define BENT (4.0 / 27.0)

/* The change of the slow velocity in `h` periods, if its rate is `rate` and falls by `gain` of the change. */
static double change_on_tangent(double rate, double gain, double h) {
    double z = h * gain;
    return h * rate * (fabs(z) > EPSILON ? expm1(z) / z : 1.0);
}

/* The factor by which an error of the slow velocity changes until its rate is `acceleration`: it changes as the rate
 * does. */
static double factor_until(const SlowPath *path, double acceleration) {
    const SlowRates *begin = &path->here.rates;
    bool moves = fabs(begin->acceleration) > begin->error;
    return moves ? fmax(fabs(acceleration / begin->acceleration), EPSILON) : 1.0;
}

/* Number of periods over which an error of the rates adds up, of `h` periods in which errors change by a factor. */
static double periods_of_error(double factor, double h) {
    double logarithm = log(factor);
    return fabs(logarithm) > EPSILON ? h * (factor - 1.0) / logarithm : h;
}

/* Error of a rate on the line between two points where that is the tangent at the first one: by the slope at the other.
 * A line that meets the rates there by accident has the wrong slope. Next to the start the difference of slopes is
 * rounding: the slope is taken to change by at most itself over the reach of a step. */
static double error_of_line(const SlowPath *path, const PathPoint *to, double length) {
    const SlowRates *first = &path->here.rates, *last = &to->rates;
    double slope = first->jerk / first->acceleration;
    double bent = fabs(last->jerk / last->acceleration - fmin(0.0, slope));
    return BENT * fabs(length) * fmin(bent, fabs(slope * length) / reach_of_step(path));
}

static double interpolated_acceleration(const SlowPath *path, double velocity) {
    double values[FUNCTIONS];
    interpolant_at(&path->interpolant, velocity, TRAVEL, values);
    return values[ACCELERATION];
}

static bool interpolated_rate(void *data, double t, double v, SlowRate *rate) {
    (void)t;
    double values[FUNCTIONS];
    interpolant_at(data, v, FAST, values);
    *rate = (SlowRate){values[ACCELERATION], values[TRAVEL]};
    return true;
}

/* First step over the time in which rates change, where the slow velocity still changes by one tolerance: most devices
 * hold it. */
#define EXPECTED_STEP 3.3

double expected_step(const SlowPath *path) {
    const PeriodMap *map = path->manifold.map;
    double acceleration = fabs(path->here.rates.acceleration);
    double gain = fabs(path->here.rates.jerk) / fmax(acceleration, SMALLEST);
    double change = acceleration / (fmax(gain, SMALLEST) * map->speed);
    double share = map->tolerance / fmax(change, SMALLEST);
    return gain > 0.0 ? EXPECTED_STEP / gain * exp(log(share) / ORDER) : INFINITY;
}

/* Integrate interpolated rates over `h` periods; a velocity that settles to a share of `allowed` stays. Return false
 * where it changes by more than `reach`, or by jumps. */
static bool integrate(SlowPath *path, double h, double reach, double allowed, SlowPoint *now) {
    const PathPoint *here = &path->here;
    double step = expected_step(path); /* a longer one may have a small estimate by accident */
    *now = (SlowPoint){.velocity = here->velocity, .rate = {here->rates.acceleration, here->rates.travel}};
    while (now->t < h) {
        SlowStep found;
        step = fmin(step, h - now->t);
        if (now->t + step == now->t) {
            return false;
        }
        runge_kutta_step(interpolated_rate, &path->interpolant, now, step, &found);
        bool beyond = !(fabs(found.to.velocity - here->velocity) <= reach);
        if (found.error <= SMALL_SHARE * allowed) {
            if (beyond) {
                return false;
            }
            double change = fabs(found.to.velocity - now->velocity);
            double rate = fabs(found.to.rate.acceleration);
            double slowed = fabs(now->rate.acceleration) - rate;
            *now = found.to;
            if (rate * change <= slowed * SMALL_SHARE * allowed) {
                break;
            }
        }
        step *= beyond ? SHORTER : step_growth(found.error, SMALL_SHARE * allowed);
    }
    now->travel += (h - now->t) * now->rate.travel;
    return true;
}

/* In this order:
 *
 * 1. stay where the velocity hardly changes;
 * 2. follow the tangent to an end, and evaluate the rates there;
 * 3. do so at points between, each where the interpolated rates may err most, until the last one shows no error;
 * 4. integrate them to a new end, and evaluate that: it is where to land, if with one point more the end is the
 * same. */
static bool try_step(SlowPath *path, double h, PathStep *result) {
    const PeriodMap *map = path->manifold.map;
    const PathPoint *here = &path->here;
    double rate = here->rates.acceleration, allowed = map->tolerance * map->speed;
    double reach = reach_of_step(path);
    if (fabs(rate) <= fmax(SMALL_SHARE * allowed / h, ROUNDING * map->speed)) {
        *result = (PathStep){h, h * here->rates.travel, 1.0, h * here->rates.error};
        return true;
    }
    double gain = fmin(0.0, here->rates.jerk / rate);
    double end = here->velocity + change_on_tangent(rate, gain, h);
    double at = end, expected = rate + gain * (end - here->velocity);
    if (!(fabs(end - here->velocity) <= reach)) {
        return false;
    }
    PathPoint landing;
    bool landed = true;
    while (path->interpolant.count < MAX_POINTS && evaluate(path, here->n, at)) {
        interpolate_last(path);
        if (path->interpolant.count == 2) {
            landing = path->last;
        }
        double residual = fabs(path->last.rates.acceleration - expected);
        double factor = factor_until(path, interpolated_acceleration(path, end));
        double periods = periods_of_error(factor, h);
        bool likely = IMPROVED * periods * residual <= allowed;
        if (path->interpolant.count == 2) {
            likely = likely && periods * error_of_line(path, &landing, end - here->velocity) <= allowed;
        }
        if (likely) {
            SlowPoint to;
            if (!integrate(path, h, reach, allowed, &to)) {
                return false;
            }
            double error = fabs(to.velocity - end);
            if (landed && error <= allowed) {
                path->last = landing;
                error += periods * error_of_rates(path);
                *result = (PathStep){h, to.travel, factor, error};
                return true;
            }
            end = to.velocity;
            if (!evaluate(path, here->n, end)) {
                return false;
            }
            landing = path->last;
        }
        landed = likely;
        at = interpolant_gap(&path->interpolant, here->velocity, end);
        expected = interpolated_acceleration(path, at);
    }
    return false;
}

bool interpolated_step(SlowPath *path, double *h, PathStep *result) {
    bool passes = try_step(path, *h, result);
    *h *= passes ? LONGER : SHORTER;
    return passes;
}

/* Largest accepted estimate of the error of a step, in tolerances. */
#define STEP_TOLERANCE 3.0

/* The estimate, of order 4, over the error of the result, of order 5. */
#define OVERESTIMATE 5.0

/* What the error of Hermite's rule counts: it mostly is one to two times the estimate. */
#define HERMITE_SHARE 0.5

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

double periods_in_beat(const PeriodMap *map, double n) {
    double chirp = map->system.plant.normal_rate * map->period * map->period;
    return PI / 4.0 / fabs(map->drift + chirp * n);
}

/* What a change of the slow velocity over `h` periods differs by from the integral of the cubic with the rates at both
 * ends, and their slopes: the error of the embedded method may be small by accident, but not both. */
static double hermite_error(const PathPoint *from, const PathPoint *to, double h) {
    const SlowRates *first = &from->rates, *last = &to->rates;
    double mean = 0.5 * (first->acceleration + last->acceleration) + h / 12.0 * (first->jerk - last->jerk);
    return fabs(to->velocity - from->velocity - h * mean);
}

bool embedded_step(SlowPath *path, double *h, PathStep *result) {
    const PeriodMap *map = path->manifold.map;
    const PathPoint *here = &path->here;
    SlowRate rate = {here->rates.acceleration, here->rates.travel};
    SlowPoint from = {here->n, here->velocity, 0.0, rate};
    double to_reach = reach_of_step(path) / fmax(fabs(rate.acceleration), SMALLEST);
    double in_beat = periods_in_beat(map, here->n);
    double allowed = STEP_TOLERANCE * map->tolerance * map->speed;
    SlowStep step;
    *h = floor(fmin(*h, fmin(in_beat, to_reach)));
    bool found = *h >= SHORTEST_STEP && runge_kutta_step(rate_at, path, &from, *h, &step);
    double estimate = found ? fmax(step.error, HERMITE_SHARE * hermite_error(here, &path->last, *h)) : INFINITY;
    if (!isfinite(estimate)) {
        *h *= SHORTER;
        return false;
    }
    double error_of_rate = error_of_rates(path), gain = 0.0;
    if (fabs(step.risen) > error_of_rate) {
        gain = fmin(0.0, fmax(step.gain, -MAX_DECAY * map->share));
    }
    double factor = exp(gain * *h), error = estimate / OVERESTIMATE + *h * error_of_rate;
    *result = (PathStep){*h, step.to.travel, factor, error};
    *h *= step_growth(estimate, allowed);
    return estimate <= allowed;
}
