/* How long motion must be resolved: until the transient of the resonator has decayed. */
#ifndef SLIDER_RESOLVED_START_H
#define SLIDER_RESOLVED_START_H

#include <stdbool.h>

#include "law.h"

/* Whether transients decay within the largest number of turns that are resolved. */
bool resolved_is_bounded(const Law *law);

/* Drive angle [rad], whole turns, until resonator and bristle have become periodic, from their state at a
 * moment. */
double resolved_angle(const Law *law, const Moment *moment);

/* The same after a change of friction, which adds the share `added_mass` to the total mass. */
double lag_angle(const Law *law, double added_mass);

#endif
