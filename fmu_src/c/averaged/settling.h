/* The last approach of averaged motion to a steady velocity, in closed form. */
#ifndef SLIDER_SETTLING_H
#define SLIDER_SETTLING_H

#include <stdbool.h>

/* Acceleration [m/s^2] at time `t` [s] and velocity `v` [m/s]. */
typedef double (*AccelerationFunction)(const void *motion, double t, double v);

/* Where an integration is: time [s], velocity [m/s], displacement [m], the step size to try next [s], and
 * the number of steps `tried`. */
typedef struct {
    double t, velocity, moved, step;
    int tried;
} Reached;

/* Advance `now` to time `end` [s] if its velocity is close to one at which forces balance, relative to the
 * `fast` velocity [m/s], and reaches that well before `end`. Return whether that is so. The acceleration
 * must not depend on time. */
bool settle(AccelerationFunction acceleration, const void *motion, double fast, double end,
            Reached *now);

/* Whether forces balance `now` and draw the velocity back to where it is: the acceleration, which must not
 * depend on time, is `noise` [m/s^2], its rounding error. */
bool is_settled(AccelerationFunction acceleration, const void *motion, double fast, double noise,
                const Reached *now);

#endif
