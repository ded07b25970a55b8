/* The error of slow motion along held orbits, carried on from step to step.
 *
 * Under held inputs V errs by its acceleration times a time that grows by what orbits have gained (see
 * orbit_shifts.h). What a jump of inputs leaves as it is is the error of W, which `ahead` keeps. */
#ifndef SLIDER_ORBIT_ERROR_H
#define SLIDER_ORBIT_ERROR_H

#include <stdbool.h>

#include "orbit_ride.h"

/* What counts at one moment of a ride: slow velocity [m/s] and acceleration [m/s^2]; the time [s] by which V
 * is ahead of the motion whose W it has; the added mass, over the mass, that the table leaves out; and
 * how far the resonator lags [m], over the acceleration.
 * `measured` is false where there are no shifts, `beyond` true where the slider never turns back. */
typedef struct {
    bool measured, beyond;
    double velocity, acceleration, lag, of_turn, left_out, swing, unsure;
} ErrorPlace;

/* The place at a velocity [m/s] and drive phase `theta` [rad] over all turns of the orbit, under the inputs with
 * which the ride begins. */
ErrorPlace error_place(OrbitRide *ride, double velocity, double theta);

/* Begin with what resolved motion leaves at the moment `now`, whose W belongs to a velocity [m/s] and the orbit
 * `point`. */
void error_begin(OrbitRide *ride, const OrbitPoint *point, double velocity, double theta,
                 const Moment *now, OrbitState *orbit);

/* Leave orbits for resolved motion, which begins without the lag of the resonator. */
void error_leave(const Law *law, OrbitState *orbit);

/* Let the resonator's swing decay for a drive angle [rad]. */
void error_calm(const Law *law, double angle, OrbitState *orbit);

/* Carry the error on over `duration` [s] to another place, whose orbit is `point`. */
void error_carry(OrbitRide *ride, const ErrorPlace *from, const ErrorPlace *to,
                 const OrbitPoint *point, double duration, OrbitState *orbit);

/* The estimate [m/s] for the mean velocity of the period that ends there. */
double error_at(OrbitRide *ride, const ErrorPlace *place, const OrbitState *orbit);

#endif
