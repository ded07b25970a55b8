/* The interface of a friction law to averaged motion: means over a turn of the drive.
 *
 * The slider moves with V - v_q cos(tau), so that it slides forward while tau is in (Theta, 2 pi -
 * Theta) with Theta = arccos(V / v_q). */
#ifndef SLIDER_AVERAGED_FRICTION_H
#define SLIDER_AVERAGED_FRICTION_H

#include <stdbool.h>

#include "../device/vibrating_load.h"
#include "bristle.h"

/* Fast velocity amplitude v_q [m/s] and drive frequency [rad/s]. */
typedef struct {
    double velocity, frequency;
} FastMotion;

/* Means over a turn of tau of the friction per unit load, times 1, sin(n tau) and cos(n tau). */
typedef struct {
    double plain, sine, cosine;
} FrictionMeans;

/* `turning` is Theta [rad], in [0, pi]. */
typedef struct {
    /* Whether each mean costs a quadrature, so that a table of means pays. */
    bool is_expensive;

    /* Largest friction per unit load that resists a vibration of this amplitude [m] and frequency
     * [rad/s] about rest. */
    double (*grip)(const Bristle *bristle, double amplitude, double frequency);

    /* Largest friction per unit load beyond mu at a fast velocity [m/s]; above mu, mean friction may
     * rise with Theta. */
    double (*drag)(const Bristle *bristle, double fast_velocity);

    /* Mean friction [N] of one face. */
    double (*mean)(const Bristle *bristle, const FastMotion *fast, const VibratingLoad *load,
                   double turning);

    /* The parts of the mean friction under a load N0 + dN sin(n tau + delta), n not 0: per face it is
     * N0 plain + dN (cos(delta) sine + sin(delta) cosine). */
    FrictionMeans (*means)(const Bristle *bristle, const FastMotion *fast, double n,
                           double turning);

    /* Damping by bends of the bristle after reversals, over Coulomb friction; 0 without a bristle. */
    double (*bend_damping)(const Bristle *bristle, const FastMotion *fast);

    /* Decay of a bend in a turn of the drive, the exponent; infinite without a bristle. */
    double (*bend_decay)(const Bristle *bristle, const FastMotion *fast);
} AveragedFriction;

extern const AveragedFriction AVERAGED_COULOMB, AVERAGED_LUGRE;

#endif
