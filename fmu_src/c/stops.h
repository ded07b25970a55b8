/* Where the slider is expected to stop: near where it stopped one drive turn before, most often. */
#ifndef SLIDER_STOPS_H
#define SLIDER_STOPS_H

#include <math.h>

#include "angle.h"

/* Change of the phase of a stop [rad] in a turn up to which it counts as a drift. */
#define MOST_DRIFT 0.1

/* Drive phase [rad] at which the slider last stopped after sliding in one direction, not a number
 * before it did, and how far that is from where it stopped before. */
typedef struct {
    double theta, drift;
} Stop;

/* One for each direction of sliding. */
typedef struct {
    Stop backward, forward;
} Stops;

static inline Stops stops_none(void) {
    Stops stops = {{NAN, 0.0}, {NAN, 0.0}};
    return stops;
}

/* Takes in a stop at drive phase `theta` [rad]. */
static inline void stop_note(Stop *stop, double theta) {
    double drift = theta - stop->theta;
    stop->drift = fabs(drift) < MOST_DRIFT ? drift : 0.0;
    stop->theta = theta;
}

/* Time [s] from drive phase `theta` to the next stop if it drifts on as it did, or not a number. */
static inline double stop_expected(const Stop *stop, double theta, double drive_frequency) {
    return within_turn(stop->theta + stop->drift - theta) / drive_frequency;
}

#endif
