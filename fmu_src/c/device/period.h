/* Means over whole drive periods, which end where the drive phase theta passes 2 pi. */
#pragma once

#include <stdbool.h>

/* Angle [rad] by which the end of a period may be ahead and still count as reached, so that steps of whole periods
 * complete their last period in spite of rounding. */
#define PERIOD_END_TOLERANCE 1e-7

/* Sums since the last period ended, and the means of the last whole period.
 *
 * `travel` [m], `work` of friction [J], `elapsed` [s] and `sticking` [s] since the last period ended (or the start);
 * `mean_velocity` [m/s], `friction_power` [W] and `stick_fraction` of the last whole period once `complete`, 1 or 0. */
typedef struct {
    double travel, work, elapsed, sticking;
    double complete, mean_velocity, friction_power, stick_fraction;
} PeriodMeans;

/* Displacement [m] and work of friction [J] since a motion began. */
typedef struct {
    double travel, work;
} Passage;

/* The passage of a motion after `t` [s]. */
typedef Passage (*PassageFunction)(const void *motion, double t);

/* An interval of motion of `duration` [s]: `passage_at(motion, t)` is its passage; `passed` and `velocity` [m/s] are
 * those at its end. */
typedef struct {
    double duration, velocity;
    Passage passed;
    bool sticks;
    PassageFunction passage_at;
    const void *motion;
} Interval;

/* Add an interval that began at drive phase `theta` [rad]. Return the drive phase at its end, modulo 2 pi. */
double period_advance(PeriodMeans *means, const Interval *interval, double theta, double frequency);

/* Mean velocity [m/s] of the last whole period; before one has ended the mean since the start, and at the start
 * `velocity`. */
double period_mean_velocity(const PeriodMeans *means, double velocity);

/* Mean power of friction [W], likewise; at the start `power`. */
double period_friction_power(const PeriodMeans *means, double power);

/* Fraction of time that the slider sticks, likewise. */
double period_stick_fraction(const PeriodMeans *means, bool sticks);
