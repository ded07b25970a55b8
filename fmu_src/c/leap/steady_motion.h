/* Periodic motion of the full device as a fixed point of the period map: steady motion, and motion that a load blocks. */
#ifndef SLIDER_STEADY_MOTION_H
#define SLIDER_STEADY_MOTION_H

#include "period_map.h"

/* Mean velocity [m/s] and load [N] of a periodic motion. */
typedef struct {
    double velocity, load;
} Periodic;

/* Find the steady motion under the load of the map, at normal phase `psi` [rad] at the section, from a slow velocity [m/s] on.
 * Return false where none is found or where it is not stable. */
bool find_steady(const PeriodMap *map, double psi, double velocity, Periodic *motion);

/* Find the motion without travel, and the load that it takes, likewise, from a `load` [N] on. */
bool find_blocked(const PeriodMap *map, double psi, double load, Periodic *motion);

#endif
