/* A polynomial on a panel, which stands for [-1, 1], in Newton's form: each further value adds a term.
 *
 * The nodes are Leja's: each is where a polynomial through those before errs most, so what it misses there is
 * about its largest error. The first of them pass the panel from one end to the other. */
#ifndef SLIDER_PANEL_SERIES_H
#define SLIDER_PANEL_SERIES_H

/* Maximum number of nodes of a panel, and those that pass it. */
enum { ORBIT_NODES = 20, PASSING_NODES = 5 };

/* The `count` terms for the values at the first nodes. */
typedef struct {
    int count;
    double term[ORBIT_NODES];
} PanelSeries;

/* Place of a node in the panel; it begins next to 1. */
double panel_node(int node);

double panel_series_at(const PanelSeries *series, double x);

/* Add the value at the next node; return by how much the polynomial before missed it. */
double panel_series_add(PanelSeries *series, double value);

/* The coefficients of its Chebyshev polynomials in `side` x, `side` 1 or -1. */
void panel_series_chebyshev(const PanelSeries *series, int side, double coefficient[ORBIT_NODES]);

#endif
