/* Mean friction under fast vibration, as slow motion sees it: at a slow velocity and a slow phase.
 *
 * The normal load counts with its phase near integer frequency ratios n, where that phase drifts by
 * (ratio - n) w (Appendix A for n = 1), and with its mean elsewhere. A load that lifts the contact
 * has harmonics, and counts with its phase near fractions too. LuGre friction is that of the
 * periodic bristle response, uniform in the bristle stiffness. */
#ifndef SLIDER_SLOW_FRICTION_H
#define SLIDER_SLOW_FRICTION_H

#include "law.h"

/* Which form the mean friction has. */
typedef enum {
    SLOW_COULOMB,
    SLOW_COULOMB_OVER_FLIGHT,
    SLOW_LUGRE,
    SLOW_LUGRE_UNDER_MEAN_LOAD,
    SLOW_LUGRE_OVER_FLIGHT
} SlowForm;

/* `waves` of the normal load over a turn of the drive, its `phase` [rad] now, the `drift` [rad/s]
 * of that, and its `sine`; friction `preload` and `swing` [N], per unit of friction with LuGre. The
 * tabulated `means` and the `load` of now are there where the form needs them. */
typedef struct {
    const Law *law;
    SlowForm form;
    double waves, phase, drift, sine;
    double preload, swing;
    const TabulatedMeans *means;
    VibratingLoad load;
} SlowFriction;

/* The mean friction of all faces from drive phase `theta` and normal phase `psi` [rad] on. */
SlowFriction slow_friction_of(const Law *law, double theta, double psi);

/* Its value [N] at time `t` [s] from now and slow velocity `velocity` [m/s]. */
double slow_friction_at(const SlowFriction *friction, double t, double velocity);

#endif
