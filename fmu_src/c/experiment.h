/* The time of a run, as FMI has it: what a host says of an experiment, and of each step. */
#ifndef SLIDER_EXPERIMENT_H
#define SLIDER_EXPERIMENT_H

#include <stdbool.h>

#include "refusal.h"

/* Start and stop time [s] and tolerance of an experiment, as far as they are defined. */
typedef struct {
    double start_time;
    bool stop_time_defined;
    double stop_time;
    bool tolerance_defined;
    double tolerance;
} Experiment;

/* The stop time [s], infinite where it is open. */
double experiment_end(const Experiment *experiment);

/* Refuses times and tolerances that make no sense. */
bool experiment_check(const Experiment *experiment, Refusal *refusal);

/* Refuses a step from `time` that is none, does not continue from the present time `now`, or goes
 * beyond `stop_time`, all in s. */
bool step_check(double now, double stop_time, double time, double step_size, Refusal *refusal);

#endif
