#include "first_zero.h"

#include <math.h>
#include <stdbool.h>

/* Short steps after which the shortest one doubles, and how short these are [rad]: bounds the work on signals
 * that stay within rounding of zero. */
enum { FLOOR_DOUBLING = 20 };
#define SHORT_STEP 0.01

/* Evaluations after which a search ends without a zero: reached only by motion at the limits of floating
 * point. */
enum { MAX_SEARCH_EVALUATIONS = 1000000 };

enum { MAX_NEWTON_STEPS = 60, MAX_EXPECTING_STEPS = 4 };

/* Share of the interval that two parabolas cover that is relied on: a margin for rounding. */
#define SURE 0.99

/* Smallest difference [s] between two zeros, or two steps of Newton's method. */
static double resolution(const Watch *watch) {
    return 1e-16 / watch->fastest;
}

/* Whether a step of Newton's method from here misses the zero by less than `resolution` [s]. */
static bool is_last(Signal at, double step, double resolved) {
    return at.bound * step * step <= -at.slope * resolved;
}

/* Newton's method from a point that satisfies Kantorovich's condition. */
static double newton(const Watch *watch, double t, Signal at) {
    double resolved = resolution(watch);
    for (int i = 0; i < MAX_NEWTON_STEPS; i++) {
        double step = -at.value / at.slope;
        t += step;
        if (fabs(step) <= resolved || is_last(at, step, resolved)) {
            break;
        }
        at = watch->signal(watch->motion, t);
        if (at.slope >= 0.0) {
            break;
        }
    }
    return t;
}

/* Time [s] from a point with this `value` and slope during which the signal is guaranteed to be positive. */
static double sure_ahead(double value, Signal at) {
    double root_term = sqrt(at.slope * at.slope + 2.0 * at.bound * value);
    if (at.slope < 0.0) {
        return 2.0 * value / (root_term - at.slope);
    }
    return at.bound > 0.0 ? (at.slope + root_term) / at.bound : INFINITY;
}

/* A zero, the first one or not, and how steeply the signal falls there; or NO_ZERO. */
typedef struct {
    double time, slope;
} Candidate;

/* The downward zero near `expected`, if Newton's method finds one in a few steps and before `limit`: beyond
 * that the bound of the signal may not hold. */
static Candidate zero_near(const Watch *watch, double start, double limit, double expected) {
    double resolved = resolution(watch);
    for (int i = 0; i < MAX_EXPECTING_STEPS && expected > start && expected < limit; i++) {
        Signal at = watch->signal(watch->motion, expected);
        if (!(at.slope < 0.0)) {
            break;
        }
        double step = -at.value / at.slope;
        expected += step;
        if (is_last(at, step, resolved) && expected < limit) {
            return (Candidate){expected, at.slope};
        }
    }
    return (Candidate){NO_ZERO, 0.0};
}

/* Whether the candidate is the first zero after `t`, where the signal is `at` and guaranteed to be positive
 * for `ahead` [s]: the parabola from the candidate backwards must cover the rest, beyond rounding. */
static bool is_first(Candidate candidate, const Watch *watch, double t, Signal at, double ahead) {
    double distance = candidate.time - t, back = -2.0 * candidate.slope / at.bound;
    return distance > 0.0 && distance < SURE * (ahead + back) && distance < watch->horizon &&
           candidate.slope * candidate.slope > 16.0 * watch->noise * at.bound;
}

double first_zero_near(const Watch *watch, double limit, double start, double expected) {
    double noise = watch->noise, horizon = watch->horizon;
    double t = start, shortest = 1e-7 / watch->fastest;
    Candidate candidate = zero_near(watch, start, limit, expected);
    int evaluations = 0, short_steps = 0;
    while (t < limit && evaluations < MAX_SEARCH_EVALUATIONS) {
        Signal at = watch->signal(watch->motion, t);
        double square = at.slope * at.slope, value = at.value;
        evaluations++;
        if (at.slope < 0.0) {
            if (value <= noise) {
                if (value < -noise || square > 16.0 * noise * at.bound) {
                    return t;
                }
                value = noise;
            } else if (square > 2.2 * at.bound * (value + noise)) {
                double root = newton(watch, t, at);
                return root < limit ? root : NO_ZERO;
            }
        } else if (value < noise) {
            value = noise;
        }
        double step = sure_ahead(value, at);
        if (is_first(candidate, watch, t, at, step)) {
            return candidate.time;
        }
        if (step * watch->fastest < SHORT_STEP) {
            short_steps++;
            if (short_steps % FLOOR_DOUBLING == 0) {
                shortest *= 2.0;
            }
        }
        step = step < shortest ? shortest : step;
        t += step > horizon ? horizon : step; /* NaN stays NaN, and ends the search */
    }
    return NO_ZERO;
}

double first_zero(const Watch *watch, double limit, double start) {
    return first_zero_near(watch, limit, start, NO_ZERO);
}
