#include "gauss_nodes.h"

#include <math.h>

#include "state.h"

enum { MAX_NEWTON_STEPS = 8 };

/* Size of a step of Newton's method after which another step changes nothing but rounding. */
#define CONVERGED 1e-9

/* Legendre polynomials P_0 to P_count at x in [-1, 1]. */
static void legendre(double x, int count, double values[MAX_NODES + 1]) {
    values[0] = 1.0;
    values[1] = x;
    for (int k = 1; k < count; k++) {
        values[k + 1] = ((2 * k + 1) * x * values[k] - k * values[k - 1]) / (k + 1);
    }
}

/* P_count' at an x inside the interval, from the values of the polynomials there. */
static double last_slope(double x, int count, const double *values) {
    return count * (x * values[count] - values[count - 1]) / (x * x - 1.0);
}

void gauss_nodes_prepare(GaussNodes *gauss, int count) {
    gauss->count = count;
    for (int i = 0; i < count; i++) {
        double values[MAX_NODES + 1], x = -cos(PI * (i + 0.75) / (count + 0.5));
        double step = 1.0;
        for (int k = 0; k < MAX_NEWTON_STEPS && fabs(step) > CONVERGED; k++) {
            legendre(x, count, values);
            step = values[count] / last_slope(x, count, values);
            x -= step;
        }
        legendre(x, count, values);
        double slope = last_slope(x, count, values);
        double weight = 1.0 / ((1.0 - x * x) * slope * slope);
        gauss->node[i] = 0.5 * (x + 1.0);
        gauss->weight[i] = weight;
        for (int k = 0; k < count; k++) {
            gauss->weighed[k][i] = weight * values[k];
        }
    }
    for (int i = 0; i < count; i++) {
        gauss_nodes_integrate(gauss, gauss->node[i], gauss->integral[i]);
        gauss->integral[count][i] = gauss->weight[i];
    }
}

void gauss_nodes_integrate(const GaussNodes *gauss, double end, double integral[MAX_NODES]) {
    double values[MAX_NODES + 1];
    int count = gauss->count;
    legendre(2.0 * end - 1.0, count, values);
    for (int j = 0; j < count; j++) {
        integral[j] = gauss->weight[j] * end;
    }
    for (int k = 1; k < count; k++) {
        double share = 0.5 * (values[k + 1] - values[k - 1]);
        for (int j = 0; j < count; j++) {
            integral[j] += gauss->weighed[k][j] * share;
        }
    }
}

double gauss_nodes_last(const GaussNodes *gauss, const double *values) {
    int last = gauss->count - 1;
    double higher = 0.0, lower = 0.0;
    for (int j = 0; j <= last; j++) {
        higher += gauss->weighed[last][j] * values[j];
        lower += gauss->weighed[last - 1][j] * values[j];
    }
    return fmax((2 * last + 1) * fabs(higher), (2 * last - 1) * fabs(lower));
}
