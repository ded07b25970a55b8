#include "component.h"

#include <string.h>

#include "../base/clock.h"
#include "ramped_step.h"
#include "values.h"

void component_begin(Component *component, const Memory *memory) {
    component->tables = (Tables){.memory = *memory};
}

void component_end(Component *component) {
    const Memory *memory = &component->tables.memory;
    memory->release(memory->host, component->tables.means);
    memory->release(memory->host, component->tables.bending);
}

/* Prepare the system of `values`; it replaces the present system unless it is refused. */
static bool prepare(Component *component, const double values[SETTABLE_COUNT], Refusal *refusal) {
    System system;
    if (!prepare_system(values, &component->tables, &system, refusal)) {
        return false;
    }
    component->system = system;
    component->prepared = true;
    component->theory = (Theory){0};
    return true;
}

static bool prepare_present(Component *component, Refusal *refusal) {
    return component->prepared || prepare(component, component->now.values, refusal);
}

void component_reset(Component *component) {
    component->now = (Snapshot){.lifecycle = INSTANTIATED, .stop_time = INFINITY};
    component->prepared = false;
    start_values(component->now.values);
}

bool component_setup_experiment(Component *component, const Experiment *experiment, Refusal *refusal) {
    if (!require("setupExperiment", component->now.lifecycle, INSTANTIATED, refusal) ||
        !experiment_check(experiment, refusal)) {
        return false;
    }
    component->now.time = component->now.last_event_time = experiment->start_time;
    component->now.stop_time = experiment->stop_time;
    return true;
}

bool component_enter_initialization(Component *component, Refusal *refusal) {
    return lifecycle_change(&component->now.lifecycle, "enterInitializationMode", INSTANTIATED, INITIALIZATION,
                            refusal);
}

bool component_exit_initialization(Component *component, Refusal *refusal) {
    if (!require("exitInitializationMode", component->now.lifecycle, INITIALIZATION, refusal) ||
        !prepare_present(component, refusal)) {
        return false;
    }
    component->now.moment = component->system.motion->start(&component->system);
    component->now.lifecycle = STEP_COMPLETE;
    return true;
}

bool component_terminate(Component *component, Refusal *refusal) {
    Lifecycle *lifecycle = &component->now.lifecycle;
    Lifecycle from = is_running(*lifecycle) ? *lifecycle : STEP_COMPLETE;
    return lifecycle_change(lifecycle, "terminate", from, TERMINATED, refusal);
}

/* Take over `values`; in a running component their system, too, unless it is refused. */
static bool take_values(Component *component, const double values[SETTABLE_COUNT], Refusal *refusal) {
    Snapshot *now = &component->now;
    bool same = true, in_place = true, running = is_running(now->lifecycle);
    for (size_t i = 0; i < SETTABLE_COUNT; i++) {
        bool kept = values[i] == now->values[i];
        same = same && kept;
        in_place = in_place && (kept || i == VR_PHASE || i == VR_LOAD);
    }
    if (same) {
        return true;
    }
    if (running && in_place) {
        Inputs inputs = reduced_inputs(values);
        system_change(&component->system, inputs.phase, inputs.load);
        component->theory = (Theory){0};
    } else if (running && !prepare(component, values, refusal)) {
        return false;
    }
    component->prepared = running;
    memcpy(now->values, values, sizeof now->values);
    return true;
}

bool component_set(Component *component, const unsigned *references, const double *values, size_t count,
                   Refusal *refusal) {
    double changed[SETTABLE_COUNT];
    memcpy(changed, component->now.values, sizeof changed);
    if (!change_values(changed, component->now.lifecycle, references, values, count, refusal) ||
        !take_values(component, changed, refusal)) {
        return false;
    }
    hold_inputs(component->now.derivatives, references, count);
    return true;
}

bool component_set_derivatives(Component *component, const unsigned *references, const double *values, size_t count,
                               Refusal *refusal) {
    return change_derivatives(component->now.derivatives, component->now.lifecycle, references, values, count, refusal);
}

/* The moment from which outputs are read. Until initialization ends it is the first one, which is written to
 * `first`. */
static bool moment_to_read(Component *component, unsigned reference, Moment *first, const Moment **moment,
                           Refusal *refusal) {
    if (!reading_check(component->now.lifecycle, reference, refusal) || !prepare_present(component, refusal)) {
        return false;
    }
    *moment = &component->now.moment;
    if (!has_begun(component->now.lifecycle)) {
        *first = component->system.motion->start(&component->system);
        *moment = first;
    }
    return true;
}

/* Read variables by reference or, as asked, their derivatives: all or none. */
static bool read(Component *component, bool derivatives, const unsigned *references, double *values, size_t count,
                 Refusal *refusal) {
    const Snapshot *now = &component->now;
    double found[VARIABLE_COUNT];
    Moment first;
    const Moment *moment = NULL;
    for (size_t i = 0; i < count; i++) {
        unsigned reference = references[i];
        if (reference < SETTABLE_COUNT && !derivatives) {
            found[i] = now->values[reference];
            continue;
        }
        if (!moment && !moment_to_read(component, reference, &first, &moment, refusal)) {
            return false;
        }
        const System *system = &component->system;
        if (!derivatives) {
            found[i] = output_value(reference, system, moment, now->last_event_time, &component->theory);
        } else if (!output_derivative(reference, system, moment, now->derivatives[VR_PHASE].value, &found[i],
                                      refusal)) {
            return false;
        }
        if (!isfinite(found[i])) {
            return refuse_infinite_output(refusal, VARIABLES[reference].name, found[i]);
        }
    }
    if (count > 0) { /* `values` may be null for a count of 0 */
        memcpy(values, found, count * sizeof *values);
    }
    return true;
}

bool component_get(Component *component, const unsigned *references, double *values, size_t count, Refusal *refusal) {
    return read(component, false, references, values, count, refusal);
}

bool component_get_derivatives(Component *component, const unsigned *references, double *values, size_t count,
                               Refusal *refusal) {
    return read(component, true, references, values, count, refusal);
}

/* Where a step leads: the moment at its end and, where inputs vary, the values then. */
typedef struct {
    Moment moment;
    double values[SETTABLE_COUNT];
} StepEnd;

/* Find where a step leads, at most to the event that a `search` finds; the component does not change. The motion takes
 * `duration` [s], the step size but for a rounding error. In this order: refuse a wrong state or time; advance the
 * moment; refuse numbers out of range. */
static bool find_end(Component *component, double time, double step_size, double duration, EventSearch *search,
                     StepEnd *end, Refusal *refusal) {
    const Snapshot *now = &component->now;
    const System *system = &component->system;
    Moment *after = &end->moment;
    Budget budget = budget_of(step_size);
    if (!require("doStep", now->lifecycle, STEP_COMPLETE, refusal) ||
        !step_check(now->time, now->stop_time, time, step_size, refusal)) {
        return false;
    }
    bool done = inputs_vary(now->derivatives)
                    ? ramped_step(system, &component->tables, now, duration, &budget, after, end->values, refusal)
                    : system->motion->advance(system, &now->moment, duration, search, &budget, after, refusal);
    if (!done) {
        return false;
    }
    const double reached[] = {after->position,   after->state.velocity, after->state.displacement,
                              after->state.rate, after->theta,          after->psi,
                              time + step_size};
    return all_finite(reached, sizeof reached / sizeof reached[0]) || refuse_infinite_motion(refusal, step_size);
}

/* Accept a step: go on to its end, `elapsed` [s] after `time` [s]. */
static bool accept_step(Component *component, const StepEnd *end, double time, double elapsed, Refusal *refusal) {
    Snapshot *now = &component->now;
    double age = end->moment.event_age;
    if (inputs_vary(now->derivatives) && !take_values(component, end->values, refusal)) {
        return false;
    }
    /* Without an event the age grows by the step size, up to rounding. */
    if (age < elapsed + 0.5 * now->moment.event_age) {
        now->last_event_time = time + fmax(0.0, elapsed - age);
    }
    now->moment = end->moment;
    now->time = time + elapsed;
    derivatives_used(now->derivatives);
    return true;
}

bool component_step(Component *component, double time, double step_size, Refusal *refusal) {
    StepEnd end;
    return find_end(component, time, step_size, step_size, NULL, &end, refusal) &&
           accept_step(component, &end, time, step_size, refusal);
}

/* Smallest time [s] by which a later time must differ from `time` [s] to be another number. */
static double time_resolution(double time) {
    return 2.0 * (nextafter(fabs(time), INFINITY) - fabs(time));
}

/* The part of the carry [s] that a step makes up for: at most half its size. */
static double owed_time(double carry, double step_size) {
    double half = 0.5 * step_size;
    return carry == 0.0 ? 0.0 : fmax(-half, fmin(carry, half));
}

/* Times of events are rounded to floating point numbers: the motion makes up for that in the next step, so that
 * stopping at events does not change it. */
bool component_step_to_event(Component *component, double time, double step_size, bool *event, Refusal *refusal) {
    Snapshot *now = &component->now;
    double owed = owed_time(now->time_carry, step_size), duration = step_size - owed;
    /* At an event the next one comes at a later time; elsewhere it may come at once. */
    EventSearch search = {.after = now->moment.event_age == 0.0 ? time_resolution(time) : -1.0};
    StepEnd end;
    *event = false;
    if (!find_end(component, time, step_size, duration, &search, &end, refusal)) {
        return false;
    }
    bool early = search.found && search.elapsed < duration;
    double elapsed = early ? search.elapsed + owed : step_size;
    if (!accept_step(component, &end, time, elapsed, refusal)) {
        return false;
    }
    now->time_carry = now->time_carry - owed + (lost_in_sum(time, elapsed) + search.carry);
    *event = search.found;
    return true;
}

bool component_enter_event_mode(Component *component, Refusal *refusal) {
    return lifecycle_change(&component->now.lifecycle, "enterEventMode", STEP_COMPLETE, EVENT_MODE, refusal);
}

bool component_enter_step_mode(Component *component, Refusal *refusal) {
    return lifecycle_change(&component->now.lifecycle, "enterStepMode", EVENT_MODE, STEP_COMPLETE, refusal);
}

/* Whether a moment can be that of a component: loops end on finite numbers, and periods on phases within a turn. */
static bool is_possible(const Moment *moment) {
    const double numbers[] = {moment->state.velocity, moment->state.displacement, moment->state.rate, moment->position,
                              moment->bristle,        moment->reversals};
    bool turned = moment->theta >= -PERIOD_END_TOLERANCE && moment->theta <= TAU &&
                  moment->psi >= -PERIOD_END_TOLERANCE && moment->psi <= TAU;
    bool known =
        moment->mode >= BACKWARD && moment->mode <= LIFTED && moment->sliding >= BACKWARD && moment->sliding <= FORWARD;
    return turned && known && all_finite(numbers, sizeof numbers / sizeof numbers[0]);
}

bool component_restore(Component *component, const Snapshot *snapshot, Refusal *refusal) {
    bool begun = has_begun(snapshot->lifecycle);
    if (!is_possible(&snapshot->moment)) {
        return refuse(refusal, "FMU state refused: it is damaged; must be one that an instance has had");
    }
    if (begun && !prepare(component, snapshot->values, refusal)) {
        return false;
    }
    component->prepared = begun;
    component->now = *snapshot;
    return true;
}
