/* Interpolation of several smooth functions of one variable by polynomials through points that come one by one. */
#ifndef SLIDER_INTERPOLANT_H
#define SLIDER_INTERPOLANT_H

enum { MAX_POINTS = 14, MAX_FUNCTIONS = 5 };

/* Newton's form: the divided differences at the points, in the order in which these came. */
typedef struct {
    int count, functions;
    double point[MAX_POINTS];
    double difference[MAX_POINTS][MAX_FUNCTIONS];
} Interpolant;

/* Add the values of the functions at `x`, at another point; there must be room. */
void interpolant_add(Interpolant *polynomials, double x, const double values[MAX_FUNCTIONS]);

/* Values at `x` of the first `functions` ones. */
void interpolant_at(const Interpolant *polynomials, double x, int functions,
                    double values[MAX_FUNCTIONS]);

/* The point between `from` and `to` where the interpolant may err most: where the product of the distances from all points is
 * largest (a Leja point), among equidistant ones. */
double interpolant_gap(const Interpolant *polynomials, double from, double to);

#endif
