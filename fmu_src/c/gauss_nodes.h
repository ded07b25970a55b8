/* Gauss nodes of the unit interval, with what integrates between them a function known at them. */
#ifndef SLIDER_GAUSS_NODES_H
#define SLIDER_GAUSS_NODES_H

/* Nodes, and points at which integrals and interpolants are wanted: the nodes, then the end. */
enum { NODES = 16, POINTS = NODES + 1 };

/* Of the interpolating polynomial: `integral[i][j]` is its integral from 0 to point i per value at
 * node j, exact for polynomials of degree NODES - 1, from 0 to the end of degree 2 NODES - 1; `last`
 * gives its last two Legendre coefficients, and `barycentric` are weights of the points and, at the end,
 * of 0. */
typedef struct {
    double node[NODES], weight[NODES];
    double integral[POINTS][NODES];
    double last[2][NODES];
    double barycentric[POINTS + 1];
} GaussNodes;

void gauss_nodes_prepare(GaussNodes *gauss);

#endif
