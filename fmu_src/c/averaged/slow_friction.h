/* Mean friction under fast vibration as a function of the slow velocity and the slow phase.
 *
 * The normal load counts with its phase near integer frequency ratios n, where that phase drifts by (ratio - n) w
 * (Appendix A for n = 1), and with its mean elsewhere. A load that lifts the contact has harmonics, and counts with its
 * phase near fractions too. */
#pragma once

#include <stddef.h>

#include "../friction/system.h"
#include "friction_table.h"

/* The mean friction of all faces from a moment on. */
typedef struct {
    const System *system;
    Bristle bristle;            /* rigid where there is no vibration: a bristle is then always fully bent */
    FastMotion fast;            /* the vibration */
    const FrictionTable *table; /* means of a bristle; NULL where a mean is computed whenever it is asked for */
    VibratingLoad load;         /* the normal load, with its present phase */
    double drift, chirp;        /* rate of that phase [rad/s], and growth of that [rad/s^2] */
    double fastest;             /* largest absolute value of the rate [rad/s] */
    double beat;                /* shortest time in which the phase repeats [s]; infinite if it does not drift */
    bool stands;                /* whether the load itself is slow, at a frequency ratio near 0 */
} SlowFriction;

/* The mean friction of all faces from drive phase `theta` and normal phase `psi` [rad] on. */
SlowFriction slow_friction_of(const System *system, double theta, double psi);

/* The mean friction [N] at time `t` [s] from now and slow velocity `velocity` [m/s]. */
double slow_friction_at(const SlowFriction *slow, double t, double velocity);

/* The mean power of friction [W] now, at slow velocity `velocity` [m/s]. */
double slow_friction_power(const SlowFriction *slow, double velocity);

/* The next ratio above (`direction` 1) or below (-1) `ratio` at which the phase of the load begins or ceases to
 * count. */
double next_slow_boundary(const Device *device, double ratio, double direction);
