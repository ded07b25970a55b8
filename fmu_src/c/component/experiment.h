/* The times of an experiment and of its steps, as FMI defines them. */
#pragma once

#include <math.h>

#include "../base/refusal.h"

/* Start time [s], and stop time [s], infinite if it is open; the tolerance where it is defined. */
typedef struct {
    double start_time, stop_time;
    bool tolerance_defined;
    double tolerance;
} Experiment;

/* Refuse times that are not finite or in the wrong order, and a tolerance that is not above 0. */
bool experiment_check(const Experiment *experiment, Refusal *refusal);

/* Refuse a step of `step_size` that is not above 0, does not start at the present time `now`, or ends after
 * `stop_time`, all in s. */
bool step_check(double now, double stop_time, double time, double step_size, Refusal *refusal);
