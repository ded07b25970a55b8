/* What a panel of sliding on a bending bristle needs of the device: closed forms at its Gauss nodes,
 * and how the slider responds to forces at them.
 *
 * A force f on the slider adds to its displacement the integral of G(t - tau) f(tau), with
 *
 *   G(t) = t / (M + m) + r / (M w_d) Im(exp(lambda t))
 *
 * Panels have lengths from a geometric grid, so that few tables serve a motion. A table is a function
 * of plant, length and nodes alone: whether it was there before makes no difference. */
#ifndef SLIDER_BENDING_KERNELS_H
#define SLIDER_BENDING_KERNELS_H

#include <stdbool.h>

#include "gauss_nodes.h"
#include "plant.h"

/* Points and the end once more, for their number to be even. */
enum { MAX_ROW = MAX_POINTS + 1 };

/* Complex numbers at the points of a panel. */
typedef struct {
    double re[MAX_ROW], im[MAX_ROW];
} ComplexRow;

/* What is left of forces over a panel: impulse [N s], its moment about the start [N s^2], and the real and
 * imaginary part of int exp(-lambda t) f dt [N s]. */
enum { IMPULSE, LEVER, BACK_RE, BACK_IM, LEFT };

/* At the points of a panel of one `length` [s], its nodes and its end: `time` [s], `response` G [m/(N s)],
 * `turn` exp(i q t), and `drive`, `normal` and `free`, int (exp(z s) - 1) ds from 0 to t [s] for
 * z = i w, i q and lambda; `end_drive` and `end_free` are exp(z t) at the end.
 *
 * Of forces at the nodes, first index, `travel` [m/N] makes displacements by G at the points, and of
 * impulses b that change them by b', `speed` [m/(N s)] by G'; so do `left_even` and `left_late` what is left
 * of them. `back` is exp(-lambda t) at the nodes. */
typedef struct {
    const GaussNodes *gauss;
    bool has_normal;
    double length, time[MAX_ROW], response[MAX_ROW];
    ComplexRow drive, free, normal, turn, back;
    Complex end_drive, end_free;
    double travel[MAX_NODES][MAX_ROW], speed[MAX_NODES][MAX_ROW];
    double left_even[MAX_NODES][LEFT], left_late[MAX_NODES][LEFT];
} BendingKernels;

/* Longest panel over what is asked for. */
#define MAX_KERNELS_STEP 1.0906

/* Lengths per octave, and tables that are kept. */
enum { LENGTHS_PER_OCTAVE = 8, KEPT_KERNELS = 12 };

/* A cache of kernels, for use at one place in memory; zeroed memory holds none. Those of another plant are
 * dropped, with another normal frequency only what depends on it. `key` tells length and nodes of those
 * kept, 0 of none, and `oldest` is replaced next. */
typedef struct BendingTables {
    GaussNodes gauss[NODE_COUNTS];
    double slider_mass, total_mass, mass_fraction, drive_frequency, normal_frequency;
    Complex eigenvalue;
    int key[KEPT_KERNELS], oldest;
    BendingKernels kept[KEPT_KERNELS];
} BendingTables;

/* The row of what is left of a force a and of an impulse b at `time` [s] that act with a `weight` [s]. */
void bending_left(Complex eigenvalue, Complex back, double time, double weight, double even[LEFT],
                  double late[LEFT]);

/* The kernels of the shortest panel of the grid that lasts `length` > 0 [s] or longer, for one of the
 * numbers of nodes that there are. They stay until others are asked for. */
BendingKernels *bending_kernels_of(BendingTables *tables, const Plant *plant, double length,
                                   int nodes);

#endif
