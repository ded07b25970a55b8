/* A moment of a motion: all that the motion carries from one step to the next. */
#ifndef SLIDER_MOMENT_H
#define SLIDER_MOMENT_H

#include "contact.h"
#include "period.h"
#include "state.h"
#include "stops.h"

/* Direction of the last sliding (0 before any), number of reversals, and number of sticks begun. Counts are
 * doubles: exact for more events than any run has. */
typedef struct {
    int sliding;
    double reversals, sticks;
} Counts;

/* Position [m], phases [rad], contact mode. `event_age` is the time [s] since the last event,
 * infinite before any; `bristle` is the friction sigma_0 z of the bristle per unit normal load, 0 with
 * Coulomb friction. `stops` determine where the search for a stop begins, and so the last digit of the
 * time that it finds: as part of the state they make a replay equal to the last bit. `leap_error` is what leaps
 * over periods may have added to the error of the slow velocity [m/s]. */
typedef struct {
    State state;
    double position, theta, psi;
    int mode;
    Counts counts;
    double event_age;
    PeriodMeans means;
    double bristle;
    Stops stops;
    double leap_error;
} Moment;

/* The counts after the slider has moved in `direction`. */
static inline Counts counts_slid(Counts counts, int direction) {
    counts.reversals += counts.sliding == -direction;
    counts.sliding = direction;
    return counts;
}

/* Changes to contact mode `mode`; that is an event unless it is the present mode. */
static inline void moment_enter(Moment *moment, int mode) {
    if (mode != moment->mode) {
        moment->mode = mode;
        moment->counts.sticks += mode == STICK;
        moment->event_age = 0.0;
    }
}

#endif
