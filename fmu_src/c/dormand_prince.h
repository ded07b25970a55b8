/* Dormand and Prince's 5(4) pair for one velocity and the position that it sums up to. */
#ifndef SLIDER_DORMAND_PRINCE_H
#define SLIDER_DORMAND_PRINCE_H

#include <stdbool.h>

#include "refusal.h"

/* Acceleration [m/s^2] at time `t` [s] and velocity `v` [m/s]. */
typedef double (*AccelerationFunction)(const void *motion, double t, double v);

/* Takes `*velocity` [m/s] to its value `duration` [s] later and gives the `*displacement` [m] on
 * the way. `step` [s] is tried first and `tolerance` [m/s] allowed per step. Refuses after 100 000
 * accepted and rejected steps. */
bool integrate(AccelerationFunction acceleration, const void *motion, double duration, double step,
               double tolerance, double *velocity, double *displacement, Refusal *refusal);

#endif
