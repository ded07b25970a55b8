/* Gauss and Legendre's rule, and integrals of the polynomial through values at its nodes. */
#pragma once

/* Sixteen nodes: as many as the smooth functions here need for 1e-10, and a multiple of what processors add at once. */
enum { GAUSS_NODES = 16 };

/* Nodes on [-1, 1], rising, and their weights. */
extern const double GAUSS_NODE[GAUSS_NODES], GAUSS_WEIGHT[GAUSS_NODES];

/* The polynomial through values f_j at the nodes of the unit interval has the integral sum_j integral[i][j] f_j from 0
 * to node i, and with i = GAUSS_NODES to 1. `weighed[k][j]` is Legendre polynomial k at node j times the weight of that
 * node. */
typedef struct {
    double integral[GAUSS_NODES + 1][GAUSS_NODES];
    double weighed[GAUSS_NODES][GAUSS_NODES];
} GaussIntegrals;

void gauss_integrals_prepare(GaussIntegrals *gauss);

/* The integral from 0 to `end` <= 1 of the polynomial through `values`. */
double gauss_integral(const GaussIntegrals *gauss, double end, const double *values);

/* Legendre polynomials P_0 to P_GAUSS_NODES at x in [-1, 1]. */
void legendre(double x, double polynomials[GAUSS_NODES + 1]);

/* The Legendre coefficients of the polynomial through `values`. */
void gauss_coefficients(const GaussIntegrals *gauss, const double *values, double coefficients[GAUSS_NODES]);

/* The larger absolute value of the last two of these. */
double gauss_last(const GaussIntegrals *gauss, const double *values);
