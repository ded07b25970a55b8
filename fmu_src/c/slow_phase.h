/* The slow phase of the normal load: near which fraction of the drive its frequency is. */
#ifndef SLIDER_SLOW_PHASE_H
#define SLIDER_SLOW_PHASE_H

#include <math.h>
#include <stdbool.h>

#include "device.h"

/* Near `waves` of the normal load in a turn of the drive, which repeat after `turns`, its phase drifts by
 * `drift` [rad/s], which grows by `chirp` [rad/s^2] and reaches `fastest` [rad/s] in size. `turns` is 0
 * where no phase is slow. */
typedef struct {
    int turns;
    double waves, drift, chirp, fastest;
} SlowPhase;

/* Time [s] after which a phase that drifts repeats at the earliest; infinite for one that does not. */
double slow_phase_beat(const SlowPhase *slow);

/* Parts of a radian to which leads of the normal load are rounded. */
#define LEAD_PARTS 1e9

/* A lead without the rounding errors of phases: what depends on it does not flicker, and inputs that come
 * back find what was tabulated. */
static inline double rounded_lead(double lead) {
    return nearbyint(lead * LEAD_PARTS) / LEAD_PARTS;
}

/* How far the phase drifts in `t` [s], in rad. */
static inline double slow_phase_gain(const SlowPhase *slow, double t) {
    return (slow->drift + 0.5 * slow->chirp * t) * t;
}

/* Whether it drifts at all. */
static inline bool slow_phase_drifts(const SlowPhase *slow) {
    return slow->drift != 0.0 || slow->chirp != 0.0;
}

/* The slow phase at a frequency ratio. */
SlowPhase slow_phase_of(const Device *device, double ratio);

/* The slow phase that belongs to the ratio `middle`, from another `ratio` on, which grows as long and as
 * far beyond; `chirp` [rad/s^2] is the growth of the normal frequency. */
SlowPhase slow_phase_chirped(const Device *device, double ratio, double middle, double chirp);

/* The next ratio, from `ratio` on upwards (`direction` 1) or downwards (-1), beyond which another slow phase
 * counts. */
double next_slow_boundary(const Device *device, double ratio, double direction);

#endif
