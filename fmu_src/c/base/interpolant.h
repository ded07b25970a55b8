/* Interpolation of several smooth functions of one variable by polynomials through points that come one by one. */
#pragma once

enum { MAX_POINTS = 14, FUNCTIONS = 5 };

/* Newton's form: the divided differences at the points, in the order in which these came. */
typedef struct {
    int count;
    double point[MAX_POINTS];
    double difference[MAX_POINTS][FUNCTIONS];
} Interpolant;

/* Add the values of the functions at `x`, which is no point yet; there must be room. */
void interpolant_add(Interpolant *polynomials, double x, const double values[FUNCTIONS]);

/* Values at `x` of the first `functions` functions. */
void interpolant_at(const Interpolant *polynomials, double x, int functions,
                    double values[FUNCTIONS]);

/* The point between `from` and `to` where the interpolant may err most: where the product of the distances from all points is
 * largest (a Leja point), among equidistant ones. */
double interpolant_gap(const Interpolant *polynomials, double from, double to);
