/* Tables for a panel of sliding on a bending bristle: closed forms of the motion at its Gauss nodes, and the response
 * of the slider to forces at these nodes.
 *
 * A force f on the slider adds to its displacement the integral of G(t - tau) f(tau), with
 *
 *   G(t) = t / (M + m) + r / (M w_d) Im(exp(lambda t))
 *
 * Panels have lengths from a geometric grid, so that few tables serve a motion. A table is a function of plant and
 * length alone: whether it was there before makes no difference. */
#pragma once

#include "../base/gauss_nodes.h"
#include "../device/plant.h"

/* The points of a panel: its nodes, then its end, repeated to make their number even. */
enum { END = GAUSS_NODES, POINTS = GAUSS_NODES + 2 };

/* Complex numbers at the points of a panel. */
typedef struct {
    double re[POINTS], im[POINTS];
} ComplexRow;

/* Integrals of a force f over a panel that decide on the motion after it: impulse [N s], moment of the impulse about
 * the start [N s^2], real and imaginary part of int exp(-lambda t) f dt [N s]. */
enum { IMPULSE, LEVER, BACK_RE, BACK_IM, LEFT };

/* At the points of a panel of one `length` [s]: `time` [s], `response` G [m/(N s)], `turn` exp(i q t), and `drive`,
 * `normal` and `free`, int (exp(z s) - 1) ds from 0 to t [s] for z = i w, i q and lambda; `turn` and `normal` are
 * those of `normal_frequency` q. `end_drive` and `end_free` are exp(z t) at the end. `interpolating` are the
 * barycentric weights of the points but the last.
 *
 * Matrices, the node as first index: `travel` [m/N] turns forces a into displacements at the points (by G), `speed`
 * [m/(N s)] does so for impulses b, which act as forces b' (by G'). `left_even` and `left_late` turn a and b into the
 * integrals over the panel. `slope` [1/s] turns a polynomial over the time, at the points but the last, into its
 * derivative at the nodes. */
typedef struct {
    const GaussIntegrals *gauss;
    double normal_frequency, length, time[POINTS], response[POINTS], interpolating[POINTS - 1];
    ComplexRow drive, free, normal, turn;
    Complex end_drive, end_free;
    double travel[GAUSS_NODES][POINTS], speed[GAUSS_NODES][POINTS];
    double left_even[GAUSS_NODES][LEFT], left_late[GAUSS_NODES][LEFT];
    double slope[POINTS - 1][GAUSS_NODES];
} BendingKernels;

/* Difference of the logarithms of two panel lengths in the grid, an eighth of that of 2; largest length of a panel over
 * the length asked for. */
#define LENGTH_STEP 0.08664339756999316
#define MAX_KERNELS_STEP 1.0906

/* Number of tables kept. */
enum { KEPT_KERNELS = 12 };

/* What kernels depend on, but for the normal frequency. */
typedef struct {
    double slider_mass, total_mass, mass_fraction, drive_frequency;
    Complex eigenvalue;
} PlantKey;

/* A cache of kernels, which must not move in memory; zeroed memory is an empty cache. A change of the plant empties it.
 * `key` is the place of each of `kept_count` lengths in the grid; `next` is the place of the next one. */
typedef struct BendingTables {
    GaussIntegrals gauss;
    PlantKey plant;
    int key[KEPT_KERNELS], kept_count, next;
    BendingKernels kept[KEPT_KERNELS];
} BendingTables;

/* The kernels of the shortest panel of the grid of lengths that lasts at least `length` > 0 [s]. They are valid until
 * the next call. */
BendingKernels *bending_kernels_of(BendingTables *tables, const Plant *plant, double length);
