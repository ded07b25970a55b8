#include "gauss_nodes.h"

#include <math.h>

#include "state.h"

enum { NEWTON_STEPS = 8 };

/* Legendre polynomials P_0 to P_NODES at x in [-1, 1]. */
static void legendre(double x, double values[NODES + 1]) {
    values[0] = 1.0;
    values[1] = x;
    for (int k = 1; k < NODES; k++) {
        values[k + 1] = ((2 * k + 1) * x * values[k] - k * values[k - 1]) / (k + 1);
    }
}

/* P_NODES' at an x inside the interval, from the values of the polynomials there. */
static double last_slope(double x, const double values[NODES + 1]) {
    return NODES * (x * values[NODES] - values[NODES - 1]) / (x * x - 1.0);
}

/* The zeros of P_NODES in ascending order, by Newton's method. */
static void find_nodes(GaussNodes *gauss, double node[NODES]) {
    for (int i = 0; i < NODES; i++) {
        double values[NODES + 1], x = -cos(PI * (i + 0.75) / (NODES + 0.5));
        for (int step = 0; step < NEWTON_STEPS; step++) {
            legendre(x, values);
            x -= values[NODES] / last_slope(x, values);
        }
        legendre(x, values);
        double slope = last_slope(x, values);
        node[i] = x;
        gauss->node[i] = 0.5 * (x + 1.0);
        gauss->weight[i] = 1.0 / ((1.0 - x * x) * slope * slope);
    }
}

/* The point i of the interval; 0 after the others. */
static double point(const GaussNodes *gauss, int i) {
    if (i < NODES) {
        return gauss->node[i];
    }
    return i == NODES ? 1.0 : 0.0;
}

static void prepare_barycentric(GaussNodes *gauss) {
    for (int i = 0; i <= POINTS; i++) {
        double product = 1.0;
        for (int j = 0; j <= POINTS; j++) {
            product *= i == j ? 1.0 : 4.0 * (point(gauss, i) - point(gauss, j));
        }
        gauss->barycentric[i] = 1.0 / product;
    }
}

void gauss_nodes_prepare(GaussNodes *gauss) {
    double node[NODES], at_node[NODES][NODES + 1];
    find_nodes(gauss, node);
    for (int j = 0; j < NODES; j++) {
        legendre(node[j], at_node[j]);
        for (int i = 0; i < 2; i++) {
            int k = NODES - 1 - i;
            gauss->last[i][j] = (2 * k + 1) * gauss->weight[j] * at_node[j][k];
        }
        gauss->integral[NODES][j] = gauss->weight[j];
    }
    for (int i = 0; i < NODES; i++) {
        for (int j = 0; j < NODES; j++) {
            double total = 0.5 * (node[i] + 1.0);
            for (int k = 1; k < NODES; k++) {
                total += 0.5 * (at_node[i][k + 1] - at_node[i][k - 1]) * at_node[j][k];
            }
            gauss->integral[i][j] = gauss->weight[j] * total;
        }
    }
    prepare_barycentric(gauss);
}
