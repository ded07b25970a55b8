/* The orbit on which slow motion rides: from tables, or found directly. */
#ifndef SLIDER_ORBIT_RIDE_H
#define SLIDER_ORBIT_RIDE_H

#include <stdbool.h>

#include "law.h"
#include "orbit_tables.h"
#include "slow_friction.h"

/* Where orbits come from: from the curve at one lead, from such a curve combined from a series over leads, from
 * that series where the lead drifts, or from Newton's method each time. */
typedef enum { FROM_CURVE, FROM_COMBINED, FROM_SERIES, FROM_SEARCH } OrbitSource;

/* The ride from drive phase `theta` [rad] on, where the lead is `lead` [rad]. `last` is the orbit found last, `searched`
 * whether there is one; `stops` are those of the moment before; `may_search` says whether orbits that no table has
 * are searched. Where there is no orbit, or where the orbits of the ride take more than `max_maps`, motion has to be
 * resolved for the drive angle `unknown` [rad]; for outputs averages of `first` order serve there. */
typedef struct {
    const Law *law;
    const PeriodMap *map;
    SlowPhase slow;
    double lead;
    OrbitSource source;
    OrbitCurve *curve;
    OrbitSeries series;
    SlowFriction first;
    bool may_search, searched;
    HeldOrbit last;
    Stops stops;
    int max_maps;
    double unknown;
} OrbitRide;

/* The slow phase that counts for orbits: that of a load that does not vibrate stands still. `turns` is 0,
 * too, where a turn of the drive holds far faster motion. */
SlowPhase orbit_phase_of(const Law *law);

/* The source for a device at the leads that were visited; `drifts` is whether the lead does. */
OrbitSource orbit_source_of(const OrbitState *orbit, const Device *device, bool drifts);

/* Begin a ride at `lead` [rad] with the phases of a moment. */
void ride_begin(OrbitRide *ride, const Law *law, const Moment *moment, double lead);

/* Bound the maps of a ride that searches by the turns in `duration` [s]. */
void ride_within(OrbitRide *ride, double duration);

/* The lead [rad] at time `t` [s] from the beginning. */
double ride_lead(const OrbitRide *ride, double t);

/* Slow acceleration [m/s^2] at time `t` [s] from the beginning, at a slow velocity [m/s]; not a number where
 * the orbit is unknown, which ends an integration. `rider` points to a pointer to the ride. */
double ride_acceleration(const void *rider, double t, double velocity);

/* Time [s] from `t` [s] on for which the acceleration is smooth. */
double ride_to_kink(const void *rider, double t);

/* The velocities [m/s] backward and forward beyond which friction no longer depends on them, known to a
 * `margin` [m/s]. */
void ride_edges(const OrbitRide *ride, double edge[2], double *margin);

/* The orbit at that time and velocity. Without an orbit it is the vibration under averaged friction, and
 * its error that of first order. */
OrbitPoint ride_point(OrbitRide *ride, double t, double velocity);

/* Drive phase [rad] over all turns of the orbit, for one within a turn: that at which the normal phase `chi`
 * [rad] fits the lead at time `t` [s]. */
double ride_theta(const OrbitRide *ride, double t, double theta, double chi);

/* The moment on the orbit at time `t` [s] and drive phase `theta` [rad], with this slow velocity [m/s]
 * and slow centre [m]; `theta` goes over all turns of the orbit, whose phases those of the moment are. */
bool ride_moment(OrbitRide *ride, double t, double theta, double velocity, double centre,
                 Moment *moment, OrbitPoint *point);

#endif
