/* Mean friction over a turn of the drive, uniform in the bristle stiffness.
 *
 * The slider moves with V - v_q cos(tau), so that it slides forward while tau is in (Theta, 2 pi - Theta) with Theta =
 * arccos(V / v_q), `turning` [rad] in [0, pi]. Coulomb friction, that of a rigid bristle, is an elementary integral
 * over the two arcs of sliding (eqs 4 and 20). A bristle responds periodically, and explicitly in the path between the
 * two reversals, so that the rest is a quadrature: soft bristles give the paper's slow manifold (17), hard ones (5). */
#pragma once

#include "../device/vibrating_load.h"
#include "../friction/bristle.h"

/* Fast velocity amplitude v_q [m/s] and drive frequency [rad/s]. */
typedef struct {
    double velocity, frequency;
} FastMotion;

/* Waves of the normal load over a turn of the drive beyond which only its mean counts: what they add to the mean
 * friction falls with their number, to less than 1e-3 of full friction. */
#define MAX_WAVES 1000.0

/* Means over a turn of tau of the friction per unit load, times 1, sin(n tau) and cos(n tau). */
enum { PLAIN, SINE, COSINE, MEANS };

/* Mean friction [N] of one face. */
double mean_friction(const Bristle *bristle, const FastMotion *fast, const VibratingLoad *load, double turning);

/* Mean power of friction [W] of one face at the slow velocity `velocity` [m/s], at which sliding turns by `turning`. */
double mean_power(const Bristle *bristle, const FastMotion *fast, const VibratingLoad *load, double turning,
                  double velocity);

/* The parts of the mean friction under a load N0 + dN sin(n tau + delta), n not 0: per face it is N0 plain + dN
 * (cos(delta) sine + sin(delta) cosine). */
void friction_means(const Bristle *bristle, const FastMotion *fast, double n, double turning, double means[MEANS]);
