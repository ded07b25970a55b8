/* Prediction of the next stop of the slider: mostly near the phase of its stop one drive turn before. */
#ifndef SLIDER_STOPS_H
#define SLIDER_STOPS_H

#include <math.h>

#include "../base/angle.h"

/* Largest change of the phase of a stop [rad] in a turn that counts as a drift. */
#define MAX_DRIFT 0.1

/* Drive phase [rad] at which the slider last stopped after sliding in one direction, and its difference
 * from the stop before. Before the first stop both are 0, an arbitrary guess. */
typedef struct {
    double theta, drift;
} Stop;

/* The last stop in each direction of sliding. */
typedef struct {
    Stop backward, forward;
} Stops;

static inline Stop *stop_after(Stops *stops, int direction) {
    return direction > 0 ? &stops->forward : &stops->backward;
}

/* Records a stop at drive phase `theta` [rad]. */
static inline void stop_record(Stop *stop, double theta) {
    double drift = theta - stop->theta;
    stop->drift = fabs(drift) < MAX_DRIFT ? drift : 0.0;
    stop->theta = theta;
}

/* Time [s] from drive phase `theta` [rad] to the next stop if it drifts as much as before. */
static inline double stop_expected(const Stop *stop, double theta, double drive_frequency) {
    return within_turn(stop->theta + stop->drift - theta) / drive_frequency;
}

#endif
