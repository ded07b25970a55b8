/* Gauss nodes of the unit interval, with what integrates between them a function known at them. */
#ifndef SLIDER_GAUSS_NODES_H
#define SLIDER_GAUSS_NODES_H

/* Nodes, and points at which integrals are wanted: the nodes, then the end. */
enum { MIN_NODES = 8, MAX_NODES = 24, NODES_STEP = 4, MAX_POINTS = MAX_NODES + 1 };
enum { NODE_COUNTS = (MAX_NODES - MIN_NODES) / NODES_STEP + 1 };

/* Of the polynomial through values at `count` nodes: `integral[i][j]` is its integral from 0 to point i
 * per value at node j, exact up to degree count - 1, and from 0 to the end up to degree 2 count - 1;
 * `weighed[k][j]` is Legendre polynomial k at node j times the weight of that. */
typedef struct {
    int count;
    double node[MAX_NODES], weight[MAX_NODES];
    double integral[MAX_POINTS][MAX_NODES];
    double weighed[MAX_NODES][MAX_NODES];
} GaussNodes;

void gauss_nodes_prepare(GaussNodes *gauss, int count);

/* The larger one of the last two Legendre coefficients of the polynomial through `values`. */
double gauss_nodes_last(const GaussNodes *gauss, const double *values);

/* Integrals from 0 to `end` <= 1 of the polynomial, per value at the nodes. */
void gauss_nodes_integrate(const GaussNodes *gauss, double end, double integral[MAX_NODES]);

#endif
