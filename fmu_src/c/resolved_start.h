/* How long motion must be resolved: until the transient of the resonator has decayed. */
#ifndef SLIDER_RESOLVED_START_H
#define SLIDER_RESOLVED_START_H

#include <stdbool.h>

#include "law.h"

/* Largest tolerance of LuGre friction with which motion is resolved before it goes over to orbits: what it errs
 * by stays in the slow velocity. Turns are few, so that costs little. */
#define RESOLVED_TOLERANCE 1e-9

/* Whether transients decay within the largest number of turns that are resolved. */
bool resolved_is_bounded(const Law *law);

/* Drive angle [rad], whole turns, until resonator and bristle have become periodic, from their state at a
 * moment. */
double resolved_angle(const Law *law, const Moment *moment);

/* Smallest decay of the bend of a bristle in a turn: two multipliers that are separate share their decay, and the
 * slow motion has less than half of it. */
double min_bend_decay(const Law *law);

/* Whether the bend may take longer to decay than the smallest angle that is resolved. */
bool bend_is_slow(const Law *law);

/* Drive angle [rad] until the bend has decayed whose `decay` in a turn is known. */
double bend_angle(double decay);

/* The same after a change of friction, which adds the share `added_mass` to the total mass. */
double lag_angle(const Law *law, double added_mass);

/* How far the resonator lags behind an acceleration by its inertia alone [s^2]. */
double swing_by_inertia(const Law *law);

/* What a swing [m] of the resonator adds at most to the slider's mean velocity of a turn [m/s]. */
double velocity_of_swing(const Law *law, double swing);

/* Change of slow velocity [m/s] by the friction that a free swing [m] of the resonator changes, as long as it lasts. */
double velocity_by_friction(const Law *law, double swing);

/* What a free swing adds at most to mean velocity: by what differs of it a turn later, and by friction. */
double velocity_of_free_swing(const Law *law, double swing);

#endif
