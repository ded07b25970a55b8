/* Mean friction of bristles over a turn of the drive, tabulated over the slow velocity.
 *
 * Averaged motion asks for it several times a step, and each mean costs a quadrature. Means are smooth in Theta =
 * arccos(V / v_q), with a layer at its ends that gets thinner for harder bristles: polynomials on panels, halved until
 * they hold. Turning Theta into pi - Theta mirrors the motion, so half is kept. */
#pragma once

#include "../base/gauss_nodes.h"
#include "mean_friction.h"

/* The most panels that means may need, and how many tables are kept. */
enum { MAX_PANELS = 32, TABLES = 4 };

/* Waves of the normal load over a turn up to which a table takes less time than it saves. */
#define MAX_WAVES_TABULATED 8.0

/* What means depend on: the bristle, the fast motion, and `n` waves of the normal load. */
typedef struct {
    Bristle bristle;
    FastMotion fast;
    double n;
} MeansKey;

/* The means for a key: Legendre coefficients on panels, which lie between `ends` [k] and [k + 1] and rise from 0 to pi
 * / 2 [rad]. */
typedef struct {
    MeansKey key;
    int panels;
    double ends[MAX_PANELS + 1];
    double panel[MAX_PANELS][MEANS][GAUSS_NODES];
} FrictionTable;

/* The tables that were made last; zeroed memory holds none. `next` is the place of the next one. */
typedef struct FrictionTables {
    GaussIntegrals gauss;
    int next;
    FrictionTable tables[TABLES];
} FrictionTables;

/* The means under `n` waves of the normal load over a turn, n not 0: kept, or made where there are none. They stay
 * until TABLES others were asked for. */
const FrictionTable *friction_table_of(FrictionTables *tables, const Bristle *bristle, const FastMotion *fast,
                                       double n);

/* The means when sliding turns forward at tau = `turning` in [0, pi] [rad]. */
void tabulated_means(const FrictionTable *table, double turning, double means[MEANS]);
