/* The slow motion from a moment at the section on: points of it whose rates were evaluated, and what they tell of
 * others.
 *
 * The slow velocity V obeys dV/dn = g(V, n), n being the number of periods, with g from the slow manifold (stroboscopic
 * averaging, projective integration). */
#pragma once

#include "slow_manifold.h"

/* A point, `n` periods after the start: the slow velocity [m/s], its rates, the `moment` there and the one a few
 * periods later (`after`). */
typedef struct {
    double n, velocity;
    SlowRates rates;
    Moment moment, after;
} PathPoint;

/* What is interpolated over the slow velocity: its change and the travel by period, and the fast states. */
enum { ACCELERATION, TRAVEL, FAST, FUNCTIONS = FAST + MAX_FAST };

/* Largest number of points of an interpolant. */
enum { MAX_POINTS = 14 };

/* Polynomials in Newton's form: the divided differences at slow velocities, the points, in the order in which these
 * came. */
typedef struct {
    int count;
    double point[MAX_POINTS];
    double difference[MAX_POINTS][FUNCTIONS];
} Interpolant;

/* A step begins `here`; `last` is the point that was evaluated last. Where rates do not depend on time but for the slow
 * velocity, `interpolant` goes through those of points of the step; otherwise the motion `varies`. */
typedef struct {
    Manifold manifold;
    double psi; /* normal phase at the start [rad] */
    bool varies;
    PathPoint here, last;
    Interpolant interpolant;
} SlowPath;

/* Begin a step at the point that was evaluated last. */
void begin_step(SlowPath *path);

/* Evaluate the rates at `n` periods and a slow velocity [m/s]. Return false where there are no rates: where they are
 * not exact enough, or where sliding does not repeat as it did at the start of the step, as they have a kink in
 * between. */
bool evaluate(SlowPath *path, double n, double velocity);

/* Interpolate through the point that was evaluated last, too. There must be room, and no known point next to it:
 * rounding of its rates would then add to those of others. */
void interpolate_last(SlowPath *path);

/* Values at slow velocity `x` of the first `functions` functions. */
void interpolant_at(const Interpolant *polynomials, double x, int functions, double values[FUNCTIONS]);

/* The point between `from` and `to` where the interpolant may err most: where the product of the distances from all
 * points is largest (a Leja point), among equidistant ones. */
double interpolant_gap(const Interpolant *polynomials, double from, double to);

/* Whether rates are so exact that the slow velocity errs by no more than is allowed in the time in which friction
 * changes it. */
bool are_exact(const PeriodMap *map, const SlowRates *rates);

/* Change of the slow velocity [m/s] that a step may make: half the way to a grazing velocity, where rates are
 * singular. */
double reach_of_step(const SlowPath *path);

/* The larger error of the rates [m/s per period] at the ends of a step. */
double error_of_rates(const SlowPath *path);
