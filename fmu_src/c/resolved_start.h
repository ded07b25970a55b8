/* For how long motion has to be resolved until what shook the resonator has decayed. */
#ifndef SLIDER_RESOLVED_START_H
#define SLIDER_RESOLVED_START_H

#include <stdbool.h>

#include "law.h"

/* Whether the vibration decays at all, in a number of turns that can be resolved. */
bool resolved_is_bounded(const Law *law);

/* Drive angle [rad], whole turns, until the resonator's swing at a moment has become the steady one, and
 * the bristle the periodic one. */
double resolved_angle(const Law *law, const Moment *moment);

/* The same after friction has changed while it adds a share `added_mass` of the total mass. */
double lag_angle(const Law *law, double added_mass);

/* How far the resonator lags behind an acceleration by its inertia alone [s^2]. */
double swing_by_inertia(const Law *law);

/* What a swing [m] of the resonator adds at most to the slider's mean velocity of a turn [m/s]. */
double velocity_of_swing(const Law *law, double swing);

#endif
