/* The slow motion along the orbits of a ride. */
#ifndef SLIDER_ORBIT_FOLLOW_H
#define SLIDER_ORBIT_FOLLOW_H

#include <stdbool.h>

#include "orbit_ride.h"

/* Go along orbits for `duration` [s], the last part of a step; gives whether all were known (`followed`). If not,
 * `now` is where it was. Refuses as law_advance does. */
bool orbit_follow(const Law *law, OrbitRide *ride, double duration, Budget *budget, Moment *now,
                  bool *followed, Refusal *refusal);

#endif
