/* Everything that a motion carries on from one step to the next. */
#ifndef SLIDER_MOMENT_H
#define SLIDER_MOMENT_H

#include "period.h"
#include "state.h"

enum { BACKWARD = -1, STICK = 0, FORWARD = 1, LIFTED = 2 };

/* Direction of the last sliding (0 before any), reversals of it, and sticks begun. Counts are
 * doubles, exact far beyond what a run can reach. */
typedef struct {
    int sliding;
    double reversals, sticks;
} Counts;

/* Position [m], phases [rad], contact mode. `event_age` is the time [s] since the last event,
 * infinite before any; `bristle` is the friction sigma_0 z of the bristle per unit normal load, 0 with
 * Coulomb friction. */
typedef struct {
    State state;
    double position, theta, psi;
    int mode;
    Counts counts;
    double event_age;
    PeriodMeans means;
    double bristle;
} Moment;

/* The counts once contact mode `mode` has begun. */
static inline Counts counts_begun(Counts counts, int mode) {
    counts.sticks += mode == STICK;
    return counts;
}

/* The counts once the slider has moved on in `direction`. */
static inline Counts counts_slid(Counts counts, int direction) {
    counts.reversals += counts.sliding == -direction;
    counts.sliding = direction;
    return counts;
}

#endif
