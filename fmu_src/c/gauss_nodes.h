/* Gauss nodes of the unit interval, and integrals of the polynomial through values at these nodes. */
#ifndef SLIDER_GAUSS_NODES_H
#define SLIDER_GAUSS_NODES_H

/* Numbers of nodes; points, to which integrals are taken: the nodes, then the end. */
enum { MIN_NODES = 8, MAX_NODES = 24, NODES_STEP = 4, MAX_POINTS = MAX_NODES + 1 };
enum { NODE_COUNTS = (MAX_NODES - MIN_NODES) / NODES_STEP + 1 };

/* The polynomial through values f_j at `count` nodes has the integral sum_j integral[i][j] f_j from 0 to
 * point i. That is exact up to degree count - 1, and for the last point, the end, up to degree 2 count - 1.
 * `weighed[k][j]` is Legendre polynomial k at node j times the weight of that node. */
typedef struct {
    int count;
    double node[MAX_NODES], weight[MAX_NODES];
    double integral[MAX_POINTS][MAX_NODES];
    double weighed[MAX_NODES][MAX_NODES];
} GaussNodes;

void gauss_nodes_prepare(GaussNodes *gauss, int count);

/* The larger absolute value of the last two Legendre coefficients of the polynomial through `values`. */
double gauss_nodes_last(const GaussNodes *gauss, const double *values);

/* Integral from 0 to `end` <= 1 of the polynomial, per value at each node. */
void gauss_nodes_integrate(const GaussNodes *gauss, double end, double integral[MAX_NODES]);

#endif
