/* Motion that drifts from orbit to orbit as its slow velocity changes. */
#ifndef SLIDER_ORBIT_DRIFT_H
#define SLIDER_ORBIT_DRIFT_H

#include "held_orbit.h"

/* The moment at drive phase `theta` [rad], from 0 up to 2 pi `turns`, of a motion under `load` [N]
 * whose slow velocity is that of the orbit just then: with its lag where the orbit is linearised,
 * otherwise that of the orbit itself. Its position is what the fast motion adds to the integral of
 * the slow velocity, 0 at the section. False where the map fails. */
bool held_orbit_moment(const PeriodMap *map, const HeldOrbit *orbit, double load, double theta,
                       Moment *moment);

/* W - V [m/s] at a moment that belongs to the orbit. */
double held_orbit_offset(const PeriodMap *map, const HeldOrbit *orbit, const Moment *moment);

#endif
