/* The slow phase of the normal load: near which fraction of the drive its frequency is. */
#ifndef SLIDER_SLOW_PHASE_H
#define SLIDER_SLOW_PHASE_H

#include <math.h>

#include "device.h"

/* Near `waves` of the normal load in a turn of the drive, which repeat after `turns`, its phase drifts by
 * `drift` [rad/s]. `turns` is 0 where no phase is slow. */
typedef struct {
    int turns;
    double waves, drift;
} SlowPhase;

/* Time [s] after which a phase that drifts repeats; infinite for one that does not. */
double slow_phase_beat(const SlowPhase *slow);

/* Parts of a radian to which leads of the normal load are rounded. */
#define LEAD_PARTS 1e9

/* A lead without the rounding errors of phases: what depends on it does not flicker, and inputs that come
 * back find what was tabulated. */
static inline double rounded_lead(double lead) {
    return nearbyint(lead * LEAD_PARTS) / LEAD_PARTS;
}

/* The slow phase at a frequency ratio. */
SlowPhase slow_phase_of(const Device *device, double ratio);

#endif
