/* The interface of a kind of motion: a row of functions.
 *
 * Motion is resolved (fidelity 1 and 2), averaged (fidelity 0, order 1), or leaps over periods (fidelity 0, order 2):
 * component_system.c picks it. A system is prepared, a motion started, then advanced step by step, to an event if one
 * is wanted; all else reads the moment in between. */
#pragma once

#include "events.h"

/* Rates of the state and of the mean velocity [m/s, m/s^2]. */
typedef struct {
    State state;
    double mean_velocity;
} Rates;

typedef struct Motion {
    /* The first moment, at drive and normal phase 0, from the initial values of the device. */
    Moment (*start)(const System *system);

    /* Advance by `duration` > 0 [s] from `moment` to `after`, another moment, or to the event that a `search` finds
     * before. NULL searches for none; only resolved motion has events to find. Refuses, with `after` undefined, a
     * motion of more work than the budget of the communication step has. Where numbers leave the range of floating
     * point, entries of `after` are not finite; loops end all the same. */
    bool (*advance)(const System *system, const Moment *moment, double duration, EventSearch *search, Budget *budget,
                    Moment *after, Refusal *refusal);

    /* Contact mode under the held inputs. */
    int (*mode)(const System *system, const Moment *moment);

    /* Friction force [N] on the slider in contact mode `mode`, positive against +X. */
    double (*force)(const System *system, const Moment *moment, int mode);

    /* Mean power of friction [W] of the last whole drive period, or since the start. */
    double (*power)(const System *system, const Moment *moment);

    Rates (*rates)(const System *system, const Moment *moment);

    /* Estimate of the error of the slow velocity [m/s]. */
    double (*error)(const System *system, const Moment *moment);

    /* Where inputs grow by `ramp`: the time [s], at most `left`, for which one system holds that is prepared for its
     * middle. NULL: all of it. */
    double (*part)(const Device *device, const Ramp *ramp, double left);
} Motion;

extern const Motion RESOLVED_MOTION, AVERAGED_MOTION, LEAPING_MOTION;

/* What motion that leaps over periods shares with resolved motion; the error is that which leaps have left. */
Moment resolved_start(const System *system);
int resolved_mode(const System *system, const Moment *moment);
double resolved_force(const System *system, const Moment *moment, int mode);
double resolved_power(const System *system, const Moment *moment);
Rates resolved_rates(const System *system, const Moment *moment);
double resolved_error(const System *system, const Moment *moment);
