/* A moment of a motion: all that the motion carries from one step to the next. */
#pragma once

#include "contact.h"
#include "period.h"

/* Largest change of the phase of a stop [rad] in a turn that counts as a drift. */
#define MAX_DRIFT 0.1

/* Drive phase [rad] at which the slider last stopped after sliding in one direction, and its first and second
 * difference from the stops before (`drift`, `curvature`): extrapolated to the next turn they expect the next stop.
 * Before the first stop all are 0, an arbitrary guess. */
typedef struct {
    double theta, drift, curvature;
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
    drift = fabs(drift) < MAX_DRIFT ? drift : 0.0;
    stop->curvature = drift != 0.0 && stop->drift != 0.0 ? drift - stop->drift : 0.0;
    stop->drift = drift;
    stop->theta = theta;
}

/* Time [s] from drive phase `theta` [rad] to the next stop, if that goes on as the last three. */
static inline double stop_expected(const Stop *stop, double theta, double drive_frequency) {
    return within_turn(stop->theta + stop->drift + stop->curvature - theta) / drive_frequency;
}

/* `stops` determine where the search for a stop begins, and so the last digit of the time that it finds: as part of the
 * state they make a replay equal to the last bit. */
typedef struct {
    State state;       /* velocity [m/s] of the slider; those of the resonator where it is resolved */
    double position;   /* of the slider [m] */
    double theta, psi; /* phases of the drive and of the normal load [rad], without the input `phase` */
    int mode;          /* contact mode */
    int sliding;       /* direction of the last sliding, 0 before any */
    double reversals;  /* number of reversals so far: exact for more than any run has */
    double event_age;  /* time [s] since the last event, infinite before any */
    PeriodMeans means; /* sums over the drive period that goes on, means over the last whole one */
    double bristle;    /* friction sigma_0 z of the bristle per unit normal load, 0 with Coulomb friction */
    Stops stops;       /* where the slider stopped last in each direction */
    double leap_error; /* what leaps over periods may have added to the error of the slow velocity [m/s] */
} Moment;

/* The first moment, at drive and normal phase 0, from the initial values of the device, but for mode and bristle. */
static inline Moment first_moment(const Device *device) {
    State state = {device->initial_velocity, device->initial_resonator_displacement,
                   device->initial_resonator_velocity};
    return (Moment){.state = state, .position = device->initial_position, .event_age = INFINITY};
}

/* Changes to contact mode `mode`; that is an event unless it is the present mode. */
static inline void moment_enter(Moment *moment, int mode) {
    if (mode != moment->mode) {
        moment->mode = mode;
        moment->event_age = 0.0;
    }
}
