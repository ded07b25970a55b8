/* Averaged LuGre friction under fast vibration, uniform in the bristle stiffness.
 *
 * The slider moves with V - v_q cos(tau). Over one turn of tau the bristle response to that motion
 * is periodic, and explicit in the path between the two reversals, so the mean friction is a
 * quadrature: soft bristles give the paper's slow manifold (17), hard ones Coulomb friction (5). */
#ifndef SLIDER_AVERAGED_LUGRE_H
#define SLIDER_AVERAGED_LUGRE_H

#include "bristle.h"
#include "vibrating_load.h"

/* Fast velocity amplitude v_q [m/s] and drive frequency [rad/s]. */
typedef struct {
    double velocity, frequency;
} FastMotion;

/* Friction per unit load over a turn of tau, times 1, sin(n tau) and cos(n tau): its means. */
typedef struct {
    double plain, sine, cosine;
} FrictionMeans;

/* Mean friction [N] of one face when sliding turns forward at tau = `turning` [rad], in [0, pi]:
 * the arccos(V / v_q) for the slow velocity V. */
double mean_friction(const Bristle *bristle, const FastMotion *fast, const VibratingLoad *load,
                     double turning);

/* What the mean friction is made of under a load N0 + dN sin(n tau + delta), n not 0: per face it
 * is N0 plain + dN (cos(delta) sine + sin(delta) cosine). */
FrictionMeans friction_means(const Bristle *bristle, const FastMotion *fast, double n,
                             double turning);

#endif
