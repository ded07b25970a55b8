#include "component.h"

#include <math.h>
#include <string.h>

#include "state.h"
#include "values.h"

/* Turns of the fastest oscillation in one step up to which its work is accepted. */
#define MAX_TURNS 1e8

static bool all_finite(const double *numbers, size_t count) {
    for (size_t i = 0; i < count; i++) {
        if (!isfinite(numbers[i])) {
            return false;
        }
    }
    return true;
}

static bool law_is_finite(const Law *law) {
    const Plant *plant = &law->held.plant;
    const double coefficients[] = {
        plant->total_mass,      plant->mass_fraction,     plant->normal_frequency,
        plant->slip.decay,      plant->slip.stiffness,    plant->stick.decay,
        plant->stick.stiffness, plant->drive.re,          plant->drive.im,
        plant->relative_drive,  plant->base_acceleration, plant->holding_drive.re,
        plant->spring,          plant->damper,            plant->holding_drive.im,
    };
    return all_finite(coefficients, sizeof coefficients / sizeof coefficients[0]);
}

/* Refuses values that together leave the range of floating point numbers: names the one that is most
 * decades away from its start. */
static bool refuse_extreme(const double values[SETTABLE_COUNT], Refusal *refusal) {
    size_t most = 0;
    double furthest = -1.0;
    for (size_t i = 0; i < SETTABLE_COUNT; i++) {
        double start = VARIABLES[i].start != 0.0 ? VARIABLES[i].start : 1.0;
        double distance = values[i] != 0.0 ? fabs(log10(fabs(values[i])) - log10(start)) : 0.0;
        if (distance > furthest) {
            furthest = distance;
            most = i;
        }
    }
    char value[NUMBER_SIZE], start[NUMBER_SIZE];
    const Variable *variable = &VARIABLES[most];
    return refuse(refusal, "%s = %s refused: together with the other values it leaves the range of "
                  "floating point numbers; allowed is one nearer to %s", variable->name,
                  value_text(variable, values[most], value),
                  value_text(variable, variable->start, start));
}

/* Prepares the law of `values` beside the present one, and makes it the present one if it can. */
static bool prepare(Component *component, const double values[SETTABLE_COUNT], Refusal *refusal) {
    int next = 1 - component->present;
    Device device = device_of(values);
    Inputs inputs = inputs_of(values);
    inputs.phase = remainder(inputs.phase, TAU);
    if (!law_prepare(&component->laws[next], &device, &inputs, &component->table, refusal)) {
        return false;
    }
    if (!law_is_finite(&component->laws[next])) {
        return refuse_extreme(values, refusal);
    }
    component->present = next;
    component->prepared = true;
    component->theory.known = false;
    return true;
}

static bool prepare_present(Component *component, Refusal *refusal) {
    return component->prepared || prepare(component, component->now.values, refusal);
}

static const Law *present_law(const Component *component) {
    return &component->laws[component->present];
}

void component_reset(Component *component) {
    memset(&component->now, 0, sizeof component->now);
    component->now.lifecycle = INSTANTIATED;
    component->now.stop_time = INFINITY;
    component->prepared = false;
    for (size_t i = 0; i < SETTABLE_COUNT; i++) {
        component->now.values[i] = VARIABLES[i].start;
    }
}

bool component_setup_experiment(Component *component, const Experiment *experiment,
                                Refusal *refusal) {
    if (!require("setupExperiment", component->now.lifecycle, INSTANTIATED, refusal)
        || !experiment_check(experiment, refusal)) {
        return false;
    }
    component->now.time = component->now.last_event_time = experiment->start_time;
    component->now.stop_time = experiment_end(experiment);
    return true;
}

bool component_enter_initialization(Component *component, Refusal *refusal) {
    if (!require("enterInitializationMode", component->now.lifecycle, INSTANTIATED, refusal)) {
        return false;
    }
    component->now.lifecycle = INITIALIZATION;
    return true;
}

bool component_exit_initialization(Component *component, Refusal *refusal) {
    if (!require("exitInitializationMode", component->now.lifecycle, INITIALIZATION, refusal)
        || !prepare_present(component, refusal)) {
        return false;
    }
    component->now.moment = law_start(present_law(component));
    component->now.moving = true;
    component->now.lifecycle = STEP_COMPLETE;
    return true;
}

bool component_terminate(Component *component, Refusal *refusal) {
    if (!require("terminate", component->now.lifecycle, STEP_COMPLETE, refusal)) {
        return false;
    }
    component->now.lifecycle = TERMINATED;
    return true;
}

bool component_set(Component *component, const unsigned *references, const double *values,
                   size_t count, Refusal *refusal) {
    bool changes = false;
    for (size_t i = 0; i < count; i++) {
        if (!setting_check(component->now.lifecycle, references[i], values[i], refusal)) {
            return false;
        }
        changes = changes || values[i] != component->now.values[references[i]];
    }
    if (!changes) {
        return true;
    }
    double changed[SETTABLE_COUNT];
    memcpy(changed, component->now.values, sizeof changed);
    for (size_t i = 0; i < count; i++) {
        changed[references[i]] = values[i];
    }
    bool running = component->now.lifecycle == STEP_COMPLETE;
    if (running && !prepare(component, changed, refusal)) {
        return false;
    }
    component->prepared = running;
    memcpy(component->now.values, changed, sizeof changed);
    return true;
}

/* The moment that outputs are read from: before the end of initialization the one to come, which is
 * put into `first`. */
static bool moment_to_read(Component *component, unsigned reference, Moment *first,
                           const Moment **moment, Refusal *refusal) {
    if (component->now.lifecycle == INSTANTIATED) {
        return refuse(refusal, "reading %s refused in state '%s': allowed in '%s'",
                      VARIABLES[reference].name, lifecycle_name(INSTANTIATED),
                      lifecycle_name(INITIALIZATION));
    }
    if (!prepare_present(component, refusal)) {
        return false;
    }
    *moment = &component->now.moment;
    if (!component->now.moving) {
        *first = law_start(present_law(component));
        *moment = first;
    }
    return true;
}

bool component_get(Component *component, const unsigned *references, double *values, size_t count,
                   Refusal *refusal) {
    double found[VARIABLE_COUNT];
    Moment first;
    const Moment *moment = NULL;
    for (size_t i = 0; i < count; i++) {
        if (references[i] < SETTABLE_COUNT) {
            found[i] = component->now.values[references[i]];
            continue;
        }
        if (!moment && !moment_to_read(component, references[i], &first, &moment, refusal)) {
            return false;
        }
        found[i] = output_value(references[i], present_law(component), moment,
                                component->now.last_event_time, &component->theory);
    }
    for (size_t i = 0; i < count; i++) {
        values[i] = found[i];
    }
    return true;
}

static bool bounded_work_check(const Law *law, double step_size, Refusal *refusal) {
    double frequency = LONGEST_ARC / law->held.arc;
    if (law->device.fidelity == 0 || !(step_size * frequency > TAU * MAX_TURNS)) {
        return true;
    }
    char size[NUMBER_SIZE], fastest[NUMBER_SIZE];
    return refuse(refusal, "doStep: communicationStepSize = %s refused: the fastest oscillation "
                  "has %s rad/s; allowed is a step of at most %g turns of it",
                  number_text(step_size, size), number_text(frequency, fastest), MAX_TURNS);
}

bool component_step(Component *component, double time, double step_size, Refusal *refusal) {
    Snapshot *now = &component->now;
    const Law *law = present_law(component);
    Moment after;
    if (!require("doStep", now->lifecycle, STEP_COMPLETE, refusal)
        || !step_check(now->time, now->stop_time, time, step_size, refusal)
        || !bounded_work_check(law, step_size, refusal)
        || !law_advance(law, &now->moment, step_size, &after, refusal)) {
        return false;
    }
    double end = time + step_size;
    const double reached[] = {after.position,   after.state.velocity, after.state.displacement,
                              after.state.rate, after.theta,          after.psi,
                              end};
    if (!all_finite(reached, sizeof reached / sizeof reached[0])) {
        char text[NUMBER_SIZE];
        return refuse(refusal, "doStep: communicationStepSize = %s refused: the motion leaves the "
                      "range of floating point numbers; allowed are smaller forces, frequencies or "
                      "steps", number_text(step_size, text));
    }
    if (after.event_age <= step_size) {
        now->last_event_time = time + (step_size - after.event_age);
    }
    now->moment = after;
    now->time = end;
    return true;
}

bool component_restore(Component *component, const Snapshot *snapshot, Refusal *refusal) {
    if (snapshot->moving && !prepare(component, snapshot->values, refusal)) {
        return false;
    }
    component->prepared = snapshot->moving;
    component->now = *snapshot;
    return true;
}
