/* Leaving a stick: the slider starts with neither velocity nor acceleration.
 *
 * The velocity then grows with the second power of time, v >= jerk t^2 / 2 - B t^3 / 6 while B
 * bounds its third derivative, and is positive up to t = 3 jerk / B. The search for the next zero
 * can start there, past the zero that the motion starts from. */
#ifndef SLIDER_DEPARTURE_H
#define SLIDER_DEPARTURE_H

#include "plant.h"
#include "state.h"

/* A time [s] up to which a slider released in direction `sign` is guaranteed to move on; 0 if there is no
 * guarantee. */
double departure_time(const Plant *plant, int sign, const State *state, double theta, double chi);

#endif
