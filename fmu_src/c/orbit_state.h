/* What averaged motion of second order carries on from one step to the next. */
#ifndef SLIDER_ORBIT_STATE_H
#define SLIDER_ORBIT_STATE_H

#include "oscillator.h"

/* How a step was made last: by averages of first order, resolved, or along held orbits. */
typedef enum { AVERAGED, RESOLVED, ON_ORBIT } Stage;

/* Leads and tunings up to which each new one gets a table of its own. */
enum { MAX_LEADS = 4, MAX_TUNINGS = 4 };

/* How inputs varied during a step: not at all, only the load, or so that the lead did. */
typedef enum { HELD_INPUTS, VARIED_LOAD, VARIED_LEAD } Varied;

/* What a held orbit depends on and what may change from one step to the next: input phase [rad], load
 * [N], frequency ratio, `waves` of the normal load in a turn of the drive, and the tunable parameters. */
typedef struct {
    double phase, load, ratio, waves, preload, amplitude, coefficient, base, frequency, force;
} OrbitValues;

/* Leads [rad] that were visited; `count` is MAX_LEADS + 1 once there were more. */
typedef struct {
    int count;
    double lead[MAX_LEADS];
} VisitedLeads;

/* Tables that are paid for: the last `count` curves, of these `waves` in a turn and leads [rad], and whether
 * the series over all leads is, of `series_waves`. */
typedef struct {
    int count;
    double waves[MAX_LEADS], lead[MAX_LEADS];
    int has_series;
    double series_waves;
} PaidTables;

/* What the estimate of the error has still to take in: nothing, motion on orbits, or such that begins where
 * resolved motion ends. */
typedef enum { NOTHING_OPEN, FOLLOWED, TAKEN_OVER } OpenKind;

/* That motion: `elapsed` [s] under held inputs, from a slow `velocity` [m/s] and a drive phase `angle` [rad] over
 * all turns on. Where resolved motion ended, the resonator had the `displacement` [m] and the `rate` [m/s]. */
typedef struct {
    int kind;
    double elapsed, velocity, angle, displacement, rate;
} OpenError;

/* `to_go` is the drive angle [rad] that is still to be resolved, `waited` what has been, or on an orbit whose lead
 * drifts what has been followed. On an orbit: slow
 * velocity V [m/s], slow centre [m] and lead [rad] of the normal load, and what is left of the resonator's own `swing`, by
 * which it differs from the orbit. The step was made `under` these values; `tunings`
 * counts, up to MAX_TUNINGS, how often a parameter changed the orbits. `varied` is how inputs did during
 * it, and `loading` [N/s] how fast the load grew, 0 under held inputs. W is `ahead` [m/s] of that of the full device, as far as that is known; what else V
 * may err by is `doubt` [m/s], and the resonator's swing that nobody follows is `unrest` [m/s] of mean
 * velocity. `acceleration` [m/s^2] is the slow one. The last four are those before what is `open`, which is
 * measured only where an estimate is needed. */
typedef struct {
    int stage;
    double to_go, waited, velocity, centre, lead;
    Response swing;
    OrbitValues under;
    VisitedLeads leads;
    PaidTables paid;
    int varied;
    double loading, ahead, doubt, unrest, acceleration;
    OpenError open;
    int tunings;
} OrbitState;

#endif
