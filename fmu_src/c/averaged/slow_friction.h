/* Mean friction under fast vibration as a function of the slow velocity and the slow phase.
 *
 * The normal load counts with its phase near integer frequency ratios n, where that phase drifts by
 * (ratio - n) w (Appendix A for n = 1), and with its mean elsewhere. A load that lifts the contact
 * has harmonics, and counts with its phase near fractions too. */
#ifndef SLIDER_SLOW_FRICTION_H
#define SLIDER_SLOW_FRICTION_H

#include "../friction/law.h"
#include "slow_phase.h"

/* How mean friction is computed: from the means under a sine, under a load that counts with its mean, or
 * as the mean under a load of any shape. */
typedef enum { UNDER_SINE, UNDER_MEAN_LOAD, UNDER_ANY_LOAD } SlowForm;

/* `waves` of the normal load over a turn of the drive, its present `phase` [rad] and drift (`slow`). Means are
 * `tabulated` where they are expensive, in a table that is made when it is first asked for: motion along
 * orbits seldom does. `sine` and `cosine` are those of the present phase, under a sine;
 * `load` is the present load otherwise. The phase repeats after `beat` [s]. `stands`: the load itself is
 * slow, at a frequency ratio near 0. */
typedef struct {
    const Law *law;
    const AveragedFriction *friction;
    SlowForm form;
    FastMotion fast;
    double waves, phase, beat;
    SlowPhase slow;
    bool stands, tabulated;
    double sine, cosine;
    VibratingLoad load;
} SlowFriction;

/* Whether each value costs a quadrature. */
static inline bool slow_friction_is_expensive(const SlowFriction *slow) {
    return slow->form == UNDER_ANY_LOAD && slow->friction->is_expensive;
}

/* The mean friction of all faces from drive phase `theta` and normal phase `psi` [rad] on. */
SlowFriction slow_friction_of(const Law *law, double theta, double psi);

/* Time [s] from `t` [s] on until the contact lifts or touches down, where the load itself is slow; infinite
 * elsewhere. */
double slow_friction_to_kink(const SlowFriction *slow, double t);

/* Bound on the rate of friction [N/s] beyond the fast velocity, where the load itself is slow; 0
 * elsewhere. */
double slow_friction_sway(const SlowFriction *slow);

/* The mean friction [N] at time `t` [s] from now and slow velocity `velocity` [m/s]. */
double slow_friction_at(const SlowFriction *slow, double t, double velocity);

#endif
