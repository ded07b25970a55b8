/* The error of slow motion along held orbits, carried on from step to step.
 *
 * Under held inputs V errs by its acceleration times a time that grows by what orbits have gained (see
 * orbit_shifts.h). That depends on the first and the last velocity alone, so it is measured late: where the estimate
 * is read, or where inputs change. What a jump of inputs leaves as it is is the error of W, which `ahead` keeps. */
#ifndef SLIDER_ORBIT_ERROR_H
#define SLIDER_ORBIT_ERROR_H

#include <stdbool.h>

#include "orbit_ride.h"

/* Begin with what resolved motion leaves at the moment `now`, whose W belongs to a velocity [m/s] and the orbit
 * `point`; its drive phase is `theta` [rad] over all turns of the orbit. */
void error_begin(OrbitRide *ride, const OrbitPoint *point, double velocity, double theta,
                 const Moment *now, OrbitState *orbit);

/* Jump to another orbit, on which the resonator swings: friction that this changes is not followed. */
void error_jump(const Law *law, OrbitState *orbit);

/* Leave orbits for resolved motion, which begins with the error of the tables and without the lag of the resonator. */
void error_leave(const Law *law, OrbitState *orbit);

/* Whether no orbit has been followed since resolved motion ended, so that it goes on without an error of orbits. */
bool is_without_error(const OrbitState *orbit);

/* Let the resonator's swing decay for a drive angle [rad]. */
void error_calm(const Law *law, double angle, OrbitState *orbit);

/* Follow an orbit from its velocity at drive phase `theta` [rad] over all turns on. */
void error_open(double theta, OrbitState *orbit);

/* Note that the motion has gone on for `duration` [s] to the velocity of the orbit `point`, at drive phase `theta`
 * [rad] over all turns. */
void error_follow(OrbitRide *ride, const OrbitPoint *point, double theta, double duration,
                  OrbitState *orbit);

/* Take in what is open, at drive phase `theta` [rad] over all turns, where the ride begins. */
void error_settle(OrbitRide *ride, double theta, OrbitState *orbit);

/* The estimate [m/s] for the mean velocity of the period that ends there. */
double error_at(OrbitRide *ride, double theta, const OrbitState *orbit);

#endif
