/* Tables for a panel of sliding on a bending bristle: closed forms of the motion at its Gauss nodes, and
 * the response of the slider to forces at these nodes.
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

/* The points of a panel, with the end repeated to make their number even. */
enum { MAX_ROW = MAX_POINTS + 1 };

/* Complex numbers at the points of a panel. */
typedef struct {
    double re[MAX_ROW], im[MAX_ROW];
} ComplexRow;

/* Integrals of a force f over a panel that decide on the motion after it: impulse [N s], moment of the
 * impulse about the start [N s^2], real and imaginary part of int exp(-lambda t) f dt [N s]. */
enum { IMPULSE, LEVER, BACK_RE, BACK_IM, LEFT };

/* At the points of a panel of one `length` [s], its nodes and its end: `time` [s], `response` G [m/(N s)],
 * `turn` exp(i q t), and `drive`, `normal` and `free`, int (exp(z s) - 1) ds from 0 to t [s] for
 * z = i w, i q and lambda; `end_drive` and `end_free` are exp(z t) at the end.
 *
 * Matrices, the node as first index: `travel` [m/N] turns forces a into displacements at the points (by
 * G), `speed` [m/(N s)] does so for impulses b, which act as forces b' (by G'). `left_even` and
 * `left_late` turn a and b into the integrals over the panel. `back` is exp(-lambda t) at the nodes. */
typedef struct {
    const GaussNodes *gauss;
    bool has_normal;
    double length, time[MAX_ROW], response[MAX_ROW];
    ComplexRow drive, free, normal, turn, back;
    Complex end_drive, end_free;
    double travel[MAX_NODES][MAX_ROW], speed[MAX_NODES][MAX_ROW];
    double left_even[MAX_NODES][LEFT], left_late[MAX_NODES][LEFT];
} BendingKernels;

/* Largest length of a panel over the length asked for. */
#define MAX_KERNELS_STEP 1.0906

/* Panel lengths per octave, and number of tables kept. */
enum { LENGTHS_PER_OCTAVE = 8, KEPT_KERNELS = 12 };

/* A cache of kernels, which must not move in memory; zeroed memory is an empty cache. A change of the plant
 * empties it; a change of the normal frequency drops only what depends on that. `key` encodes length and
 * nodes of each kernel kept, 0 for none; `oldest` is the one to be replaced next. */
typedef struct BendingTables {
    GaussNodes gauss[NODE_COUNTS];
    double slider_mass, total_mass, mass_fraction, drive_frequency, normal_frequency;
    Complex eigenvalue;
    int key[KEPT_KERNELS], oldest;
    BendingKernels kept[KEPT_KERNELS];
} BendingTables;

/* The integrals of a unit force a and of a unit impulse b at `time` [s], with a `weight` [s] of the
 * quadrature. */
void bending_left(Complex eigenvalue, Complex back, double time, double weight, double even[LEFT],
                  double late[LEFT]);

/* The kernels of the shortest panel of the grid of lengths that lasts at least `length` > 0 [s], with
 * `nodes` nodes. They are valid until the next call. */
BendingKernels *bending_kernels_of(BendingTables *tables, const Plant *plant, double length,
                                   int nodes);

#endif
