#include "component.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "values.h"

/* Largest number of samples that is accepted in one step. */
#define MAX_SAMPLES 1e6

/* Fraction of the time between two samples by which hosts may round their own time. */
#define SAMPLE_TIME_SLACK 1e-6

void component_begin(Component *component, const Memory *memory) {
    (void)component, (void)memory; /* it needs none */
}

void component_end(Component *component) {
    (void)component;
}

void component_reset(Component *component) {
    component->now = (Snapshot){.lifecycle = INSTANTIATED, .stop_time = INFINITY};
    start_values(component->now.values);
}

bool component_setup_experiment(Component *component, const Experiment *experiment, Refusal *refusal) {
    Snapshot *now = &component->now;
    if (!require("setupExperiment", now->lifecycle, INSTANTIATED, refusal) || !experiment_check(experiment, refusal)) {
        return false;
    }
    now->start_time = now->time = experiment->start_time;
    now->stop_time = experiment->stop_time;
    return true;
}

bool component_enter_initialization(Component *component, Refusal *refusal) {
    return lifecycle_change(&component->now.lifecycle, "enterInitializationMode", INSTANTIATED, INITIALIZATION,
                            refusal);
}

bool component_exit_initialization(Component *component, Refusal *refusal) {
    return lifecycle_change(&component->now.lifecycle, "exitInitializationMode", INITIALIZATION, STEP_COMPLETE,
                            refusal);
}

bool component_terminate(Component *component, Refusal *refusal) {
    return lifecycle_change(&component->now.lifecycle, "terminate", STEP_COMPLETE, TERMINATED, refusal);
}

bool component_set(Component *component, const unsigned *references, const double *values, size_t count,
                   Refusal *refusal) {
    double changed[SETTABLE_COUNT];
    memcpy(changed, component->now.values, sizeof changed);
    if (!change_values(changed, component->now.lifecycle, references, values, count, refusal)) {
        return false;
    }
    memcpy(component->now.values, changed, sizeof changed);
    return true;
}

/* Finite: a gain of 0 times it is 0, not NaN. */
static double velocity_error(const double *values) {
    double error = values[VR_VELOCITY_REFERENCE] - values[VR_MEASURED_VELOCITY];
    return fmax(-DBL_MAX, fmin(DBL_MAX, error));
}

static double output(const Snapshot *now, unsigned reference) {
    switch (reference) {
    case VR_PHASE:
        return control_phase(now->control.effort, now->values[VR_FORCE_PHASE]);
    case VR_EFFORT:
        return now->control.effort;
    default:
        return velocity_error(now->values);
    }
}

bool component_get(Component *component, const unsigned *references, double *values, size_t count, Refusal *refusal) {
    const Snapshot *now = &component->now;
    for (size_t i = 0; i < count; i++) {
        if (!reading_check(now->lifecycle, references[i], refusal)) {
            return false;
        }
    }
    for (size_t i = 0; i < count; i++) {
        unsigned reference = references[i];
        values[i] = reference < SETTABLE_COUNT ? now->values[reference] : output(now, reference);
    }
    return true;
}

bool component_step(Component *component, double time, double step_size, Refusal *refusal) {
    Snapshot *now = &component->now;
    if (!require("doStep", now->lifecycle, STEP_COMPLETE, refusal) ||
        !step_check(now->time, now->stop_time, time, step_size, refusal)) {
        return false;
    }
    const double *values = now->values;
    Tuning tuning = {values[VR_PROPORTIONAL_GAIN], values[VR_INTEGRAL_GAIN], values[VR_EFFORT_LIMIT],
                     values[VR_SAMPLE_TIME]};
    double elapsed = time + step_size - now->start_time;
    double due = fmax(now->samples, ceil(elapsed / tuning.sample_time - SAMPLE_TIME_SLACK));
    if (!(due - now->samples <= MAX_SAMPLES)) {
        char text[NUMBER_SIZE], sample_time[NUMBER_SIZE];
        return refuse(refusal,
                      "doStep: communicationStepSize = %s refused: must be at most %g "
                      "samples, sample_time = %s",
                      number_text(step_size, text), MAX_SAMPLES, number_text(tuning.sample_time, sample_time));
    }
    double error = velocity_error(values);
    for (; now->samples < due; now->samples++) {
        now->control = control_sampled(&tuning, now->control, error);
    }
    now->time = time + step_size;
    return true;
}

bool component_restore(Component *component, const Snapshot *snapshot, Refusal *refusal) {
    (void)refusal;
    component->now = *snapshot;
    return true;
}
