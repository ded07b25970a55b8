/* What a panel of sliding on a bending bristle needs of the device: closed forms at its Gauss nodes,
 * and how the slider responds to forces at them.
 *
 * A force f on the slider adds to its displacement the integral of G(t - tau) f(tau), with
 *
 *   G(t) = t / (M + m) + r / (M w_d) Im(exp(lambda t))
 *
 * Panels have lengths from a geometric grid, so that few tables serve a motion. A table is a function
 * of plant and length alone: whether it was there before makes no difference. */
#ifndef SLIDER_BENDING_KERNELS_H
#define SLIDER_BENDING_KERNELS_H

#include <stdbool.h>

#include "gauss_nodes.h"
#include "plant.h"

/* Of one `length` [s], at the times of POINTS: G [s/kg], exp(i q t), and int (exp(z s) - 1) ds from 0 to
 * t for z = i w, i q and lambda [s]; `travel` [m/N] and `speed` [m/(N s)] take forces at the nodes to
 * displacements by G and by G', and `impulse` [s] to their momentum, `lever` [s^2] to the moment of it
 * about the start, `back` [s] to the free oscillation that they leave, by exp(-lambda t). */
typedef struct {
    bool known, has_normal;
    int step;
    double length, time[POINTS], response[POINTS];
    Complex drive[POINTS], free[POINTS], normal[POINTS], normal_turn[POINTS];
    double travel[POINTS][NODES], speed[POINTS][NODES];
    double impulse[NODES], lever[NODES];
    Complex back[NODES];
} BendingKernels;

/* Lengths per octave, and tables that are kept. */
enum { LENGTHS_PER_OCTAVE = 8, KEPT_LENGTHS = 16 };

/* A cache of kernels; zeroed memory holds none. Those of another plant are dropped, with another
 * normal frequency only what depends on it. */
typedef struct BendingTables {
    bool prepared;
    GaussNodes gauss;
    double slider_mass, total_mass, mass_fraction, drive_frequency, normal_frequency;
    Complex eigenvalue;
    BendingKernels kept[KEPT_LENGTHS];
} BendingTables;

/* The kernels of the shortest panel of the grid that lasts `length` > 0 [s] or longer. They stay until
 * others are asked for. */
const BendingKernels *bending_kernels_of(BendingTables *tables, const Plant *plant, double length);

#endif
