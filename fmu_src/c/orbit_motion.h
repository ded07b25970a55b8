/* Averaged motion of second order, fidelity 0: the slow motion along held orbits.
 *
 * With W = X' + r Y' + D cos(theta) / (w Mt), exactly Mt W' = -friction - load. On a held orbit W = V + w1,
 * and the slow velocity V obeys
 *
 *   Mt V' = -(1 + kappa_m) (F2(V, lead) + load)
 *
 * with the mean friction F2 of the orbit and the added mass kappa_m of friction. The resonator's own swing
 * is no slow motion: after a start and where the drive is tuned the motion is resolved until it has
 * decayed. A load leaves V as it is; another phase, preload or amplitude leaves W. Inputs that grow
 * change load and lead as time goes on. */
#ifndef SLIDER_ORBIT_MOTION_H
#define SLIDER_ORBIT_MOTION_H

#include <stdbool.h>

#include "law.h"

/* Whether the motion of the device under the inputs of a law of fidelity 0 becomes slow: the vibration
 * decays to one that breaks the contact loose, faster than friction changes the slow motion, and the phase
 * of the normal load is slow. Without friction, first order is exact. */
bool has_slow_motion(const Law *law);

/* What the first moment carries on. */
OrbitState orbit_motion_start(const Law *law, const Moment *first);

/* The moment `duration` > 0 [s] later, another than `moment`, or that of an event that a `search`
 * finds before in resolved motion. Refuses as law_advance does. */
bool orbit_motion_advance(const Law *law, const Moment *moment, double duration,
                          EventSearch *search, Budget *budget, Moment *after, Refusal *refusal);

/* Take into the estimate of the error what it has still to take in, before the law changes. */
void orbit_motion_settle(const Law *law, Moment *moment);

/* The estimate of the error of the slow velocity at a moment [m/s]. */
double orbit_motion_error(const Law *law, const Moment *moment);

#endif
