/* Steady motion as a held orbit: the velocity at which a load is the one that holds.
 *
 * Both results are exact, for a held orbit is a periodic motion of the full device. */
#ifndef SLIDER_STEADY_ORBIT_H
#define SLIDER_STEADY_ORBIT_H

#include <stdbool.h>

#include "held_orbit.h"

/* Finds the steady motion under `load` [N] to which motion at other velocities tends. Orbits at a
 * few velocities show how many there are: ORBIT_RUNS_AWAY for none, ORBIT_UNDETERMINED for several,
 * ORBIT_UNSTABLE for one that motion leaves, and the reason of the last failure where no orbit was found. */
OrbitStatus steady_orbit(const PeriodMap *map, double lead, double load, HeldOrbit *orbit);

/* The load [N] that stops the slider, in `force`. */
OrbitStatus blocking_orbit(const PeriodMap *map, double lead, HeldOrbit *orbit, double *force);

/* Whether neighbours on either side lead to no other orbit of this velocity: beside it, and where the slider does
 * not turn back. That costs some 90 maps; under weak friction there is one orbit. */
bool is_unique(const PeriodMap *map, const HeldOrbit *orbit);

#endif
