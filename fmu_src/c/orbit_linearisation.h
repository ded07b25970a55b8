/* How motion departs from a held orbit: the slow part by which V changes, and the fast vibration.
 *
 * Bristle and resonator lag behind a velocity that changes, so friction acts as an added mass kappa_m Mt
 * on the slow motion. With P the period map, rho its slow multiplier, l its left eigenvector, x_V the
 * tangent dx/dV of the orbits and P_L what a unit of load adds to the state in a period:
 *
 *   1 + kappa_m = -Mt ln(rho) / (F2' T),    (1 - rho) l.x_V = -F2' l.P_L
 *
 * F2' drops out, and where it vanishes the quotient stays regular. */
#ifndef SLIDER_ORBIT_LINEARISATION_H
#define SLIDER_ORBIT_LINEARISATION_H

#include <stdbool.h>

#include "linear_system.h"

/* In the scales of the period map. `factor` is 1 + kappa_m, 1 where `is_slow` is false: there the motion is
 * stopped within a period. `slope` is F2' T / Mt, `multiplier` rho, `fast_multiplier` the largest of the
 * others in absolute value. `tangent` is x_V. */
typedef struct {
    bool is_slow;
    double factor, slope, multiplier, fast_multiplier;
    double tangent[UNKNOWNS];
} OrbitLinearisation;

/* From the `jacobian` of P(x, L) - x and of the mean velocity by x and L, `states` rows and one. False
 * where it is singular. */
bool linearise_orbit(double jacobian[UNKNOWNS][UNKNOWNS], int states, OrbitLinearisation *result);

#endif
