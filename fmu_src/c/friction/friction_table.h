/* The means of friction over a turn of the drive, tabulated over the slow velocity.
 *
 * Averaged motion asks for them several times a step, and each costs a quadrature. They are smooth
 * in Theta = arccos(V / v_q), with a layer at its ends that gets thinner for harder bristles:
 * polynomials on panels, halved until they hold. Turning Theta into pi - Theta mirrors the motion,
 * so half is kept. */
#ifndef SLIDER_FRICTION_TABLE_H
#define SLIDER_FRICTION_TABLE_H

#include "averaged_friction.h"

/* Nodes of a polynomial, the most panels that the means may need, and how many tables are kept. */
enum { TABLE_NODES = 9, MAX_PANELS = 32, TABLES = 4 };

/* Waves of the normal load over a turn up to which a table takes less time than it saves. */
#define MAX_WAVES_TABULATED 8.0

/* The means for a friction law, its bristle, a fast motion and `n` waves of the normal load: those at the
 * Chebyshev nodes of each panel, which lie between `ends` [k] and [k + 1] and rise from 0 to pi / 2 [rad]. */
typedef struct {
    const AveragedFriction *friction;
    Bristle bristle;
    FastMotion fast;
    double n;
    int panels;
    double ends[MAX_PANELS + 1];
    FrictionMeans panel[MAX_PANELS][TABLE_NODES];
} TabulatedMeans;

/* The tables that were made last; zeroed memory holds none. `next` is the place of the next one. */
typedef struct {
    int next;
    TabulatedMeans tables[TABLES];
} FrictionTable;

/* The means under `n` waves of the normal load over a turn, n not 0: kept, or made where there are
 * none. They stay until TABLES others were asked for. */
const TabulatedMeans *friction_table_of(FrictionTable *table, const AveragedFriction *friction,
                                        const Bristle *bristle, const FastMotion *fast, double n);

/* The means when sliding turns forward at tau = `turning` in [0, pi] [rad]. */
FrictionMeans tabulated_means_at(const TabulatedMeans *table, double turning);

#endif
