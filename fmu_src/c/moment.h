/* Everything that a motion carries on from one step to the next. */
#ifndef SLIDER_MOMENT_H
#define SLIDER_MOMENT_H

#include "contact.h"
#include "orbit_state.h"
#include "period.h"
#include "state.h"
#include "stops.h"

/* Direction of the last sliding (0 before any), reversals of it, and sticks begun. Counts are
 * doubles, exact far beyond what a run can reach. */
typedef struct {
    int sliding;
    double reversals, sticks;
} Counts;

/* Position [m], phases [rad], contact mode. `event_age` is the time [s] since the last event,
 * infinite before any; `bristle` is the friction sigma_0 z of the bristle per unit normal load, 0 with
 * Coulomb friction. `stops` decide where a stop is looked for first, and so the last digit of the
 * time that is found: they are part of the state for a replay to be equal to the last bit. */
typedef struct {
    State state;
    double position, theta, psi;
    int mode;
    Counts counts;
    double event_age;
    PeriodMeans means;
    double bristle;
    Stops stops;
    OrbitState orbit;
} Moment;

/* The counts once the slider has moved on in `direction`. */
static inline Counts counts_slid(Counts counts, int direction) {
    counts.reversals += counts.sliding == -direction;
    counts.sliding = direction;
    return counts;
}

/* Goes over to contact mode `mode`, which is an event where it is another one. */
static inline void moment_enter(Moment *moment, int mode) {
    if (mode != moment->mode) {
        moment->mode = mode;
        moment->counts.sticks += mode == STICK;
        moment->event_age = 0.0;
    }
}

#endif
