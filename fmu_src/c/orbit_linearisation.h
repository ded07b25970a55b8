/* How motion departs from a held orbit: the slow part by which V changes, and the fast vibration.
 *
 * Bristle and resonator lag behind a velocity that changes, so friction acts as an added mass
 * kappa_m Mt on the slow motion. With P the period map, rho its slow multiplier, l its left
 * eigenvector, x_V the tangent dx/dV of the orbits and P_L what a unit of load adds to the state in
 * a period:
 *
 *   1 + kappa_m = -Mt ln(rho) / (F2' T),    (1 - rho) l.x_V = -F2' l.P_L
 *
 * F2' drops out, and where it vanishes the quotient stays regular.
 *
 * Off the orbit by an excess force E = F2 + load the motion is x* + xi E, V changes by dV E in a
 * period, and E by the factor rho. That is the slow motion, so that the mean velocity of a period
 * is that of V:
 *
 *   (P_x - rho) xi - x_V dV = -P_L,    X_x xi + X_L = (1 / ln(rho) + 1 / (1 - rho)) dV T */
#ifndef SLIDER_ORBIT_LINEARISATION_H
#define SLIDER_ORBIT_LINEARISATION_H

#include <stdbool.h>

#include "linear_system.h"

/* In the scales of the period map. `factor` is 1 + kappa_m, 1 where `is_slow` is false: there the
 * motion is stopped within some periods. `slope` is F2' T / Mt, `multiplier` rho, `fast_multiplier` the
 * largest of the others in absolute value. `is_separate` says that rho is one multiplier by itself, and
 * decays more slowly than the others. `tangent` is x_V, and `lag` xi, 0 where the motion is not slow. */
typedef struct {
    bool is_slow, is_separate;
    double factor, slope, multiplier, fast_multiplier;
    double tangent[UNKNOWNS], lag[UNKNOWNS];
} OrbitLinearisation;

/* From the `jacobian` of P(x, L) - x and of the mean velocity by x and L, `states` rows and one.
 * False where it is singular. */
bool linearise_orbit(double jacobian[UNKNOWNS][UNKNOWNS], int states, OrbitLinearisation *result);

/* The largest multiplier in absolute value of motion under the load of the orbit, from the same Jacobian. */
double largest_multiplier(double jacobian[UNKNOWNS][UNKNOWNS], int states);

#endif
