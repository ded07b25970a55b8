#include "first_zero.h"

#include <math.h>
#include <stdbool.h>

/* A step that cannot pass a zero may be as short as rounding allows where the signal is next to zero. Steps are then
 * lengthened to `SHORTEST_STEP`, which doubles every FLOOR_DOUBLING steps up to `SHORT_STEP` [rad]: that bounds the
 * work. What a lengthened step may pass is looked for at its end. */
enum { FLOOR_DOUBLING = 5 };
#define SHORTEST_STEP 1e-7
#define SHORT_STEP 0.01

/* Evaluations after which a search ends without a zero: reached only by motion at the limits of floating point. */
enum { MAX_SEARCH_EVALUATIONS = 1000000 };

enum { MAX_REFINEMENTS = 100, MAX_EXPECTING_STEPS = 4 };

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

/* The zero between `low`, up to which the signal is positive, and `high`, where it is not: Newton's method from `t`, at
 * one of the two, where the signal is `at`; bisection where that leaves the bracket. */
static double zero_between(const Watch *watch, double low, double high, double t, Signal at) {
    double resolved = resolution(watch);
    for (int i = 0; i < MAX_REFINEMENTS; i++) {
        bool falls = at.slope < 0.0;
        double step = falls ? -at.value / at.slope : INFINITY;
        bool inside = low <= t + step && t + step <= high;
        if (!inside) {
            step = 0.5 * (low + high) - t;
        }
        t += step;
        if (fabs(step) <= resolved || (inside && is_last(at, step, resolved))) {
            break;
        }
        at = watch->signal(watch->motion, t);
        *(at.value > 0.0 ? &low : &high) = t;
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

/* The downward zero near `expected`, if Newton's method finds one in a few steps and before `limit`: beyond that the
 * bound of the signal may not hold. */
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

/* Whether the candidate is the first zero after `t`, where the signal is `at` and guaranteed to be positive for `ahead`
 * [s]: the parabola from the candidate backwards must cover the rest, beyond rounding. */
static bool is_first(Candidate candidate, const Watch *watch, double t, Signal at, double ahead) {
    double distance = candidate.time - t, back = -2.0 * candidate.slope / at.bound;
    return distance > 0.0 && distance < SURE * (ahead + back) &&
           candidate.slope * candidate.slope > 16.0 * watch->noise * at.bound;
}

/* Whether the signal is below zero, or so steep in rounding of it that a zero is certain. */
static bool is_below(const Watch *watch, Signal at) {
    double noise = watch->noise;
    return at.slope < 0.0 && at.value <= noise && (at.value < -noise || at.slope * at.slope > 16.0 * noise * at.bound);
}

/* Time in a lengthened step from `from`, where the signal was `before`, to `to` at which the signal may be below zero
 * in between, if it turns there: on so short a way its slope changes evenly. Otherwise `to`. */
static double lowest_between(double from, Signal before, double to, Signal at) {
    bool turns = before.slope < 0.0 && at.slope > 0.0;
    return turns ? from + (to - from) * before.slope / (before.slope - at.slope) : to;
}

double first_zero(const Watch *watch, double limit, double start, double expected) {
    double noise = watch->noise;
    double t = start, from = start, shortest = SHORTEST_STEP / watch->fastest;
    double longest_forced = SHORT_STEP / watch->fastest;
    Candidate candidate = zero_near(watch, start, limit, expected);
    Signal before = {0.0, 0.0, 0.0};
    bool forced = false;
    int short_steps = 0;
    for (int i = 0; (t < limit || forced) && i < MAX_SEARCH_EVALUATIONS; i++) {
        Signal at = watch->signal(watch->motion, t);
        if (forced) {
            double lowest = lowest_between(from, before, t, at);
            Signal there = lowest < t ? watch->signal(watch->motion, lowest) : at;
            if (there.value < -noise) {
                return zero_between(watch, from, lowest, lowest, there);
            }
        }
        if (is_below(watch, at)) {
            return zero_between(watch, from, t, t, at);
        }
        double value = at.value < noise ? noise : at.value, square = at.slope * at.slope;
        if (at.value > noise && at.slope < 0.0 && square > 2.2 * at.bound * (value + noise)) {
            double root = zero_between(watch, t, t - 2.0 * value / at.slope, t, at);
            return root < limit ? root : NO_ZERO;
        }
        double step = sure_ahead(value, at);
        if (is_first(candidate, watch, t, at, step)) {
            return candidate.time;
        }
        if (step < longest_forced && ++short_steps % FLOOR_DOUBLING == 0) {
            shortest = fmin(2.0 * shortest, longest_forced);
        }
        forced = step < shortest && t < limit;
        before = at;
        from = t;
        step = forced ? fmin(shortest, limit - t) : step;
        t += step; /* NaN ends the search */
    }
    return NO_ZERO;
}
