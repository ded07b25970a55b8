/* The slow phase of the normal load: the fraction of the drive frequency that it is near to, and the drift. */
#ifndef SLIDER_SLOW_PHASE_H
#define SLIDER_SLOW_PHASE_H

#include <math.h>
#include <stdbool.h>

#include "../device/device.h"

/* The normal load is near `waves` waves in a turn of the drive, which repeat after `turns` turns; `turns` is
 * 0 where no phase is slow. Its phase drifts by `drift` [rad/s], which grows by `chirp` [rad/s^2]; `fastest`
 * is the largest absolute value of the drift [rad/s]. */
typedef struct {
    int turns;
    double waves, drift, chirp, fastest;
} SlowPhase;

/* Shortest time [s] in which a phase that drifts repeats; infinite for one that does not drift. */
double slow_phase_beat(const SlowPhase *slow);

/* Drift of the phase in `t` [s], in rad. */
static inline double slow_phase_gain(const SlowPhase *slow, double t) {
    return (slow->drift + 0.5 * slow->chirp * t) * t;
}

/* Whether the phase drifts. */
static inline bool slow_phase_drifts(const SlowPhase *slow) {
    return slow->drift != 0.0 || slow->chirp != 0.0;
}

/* The slow phase at a frequency ratio. */
SlowPhase slow_phase_of(const Device *device, double ratio);

/* The slow phase of a ratio that grows from `ratio` through `middle`, its value halfway; `chirp` [rad/s^2]
 * is the growth of the normal frequency. */
SlowPhase slow_phase_chirped(const Device *device, double ratio, double middle, double chirp);

/* The next ratio above (`direction` 1) or below (-1) `ratio` at which one slow phase gives way to another. */
double next_slow_boundary(const Device *device, double ratio, double direction);

#endif
