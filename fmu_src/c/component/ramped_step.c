#include "ramped_step.h"

#include <string.h>

#include "../base/clock.h"
#include "values.h"

/* Slow phases that a whole budget buys. */
enum { MAX_SLOW_PHASES = 1000 };

/* Values after inputs have grown for `t` [s]. */
static void grow(const Snapshot *now, double t, double values[SETTABLE_COUNT]) {
    memcpy(values, now->values, sizeof now->values);
    for (size_t i = 0; i < VARYING_COUNT; i++) {
        values[i] += now->derivatives[i].value * t;
    }
}

/* Refuse inputs out of their bounds at the end of a step of `duration` [s]. */
static bool reached_check(const Snapshot *now, const double reached[SETTABLE_COUNT], double duration,
                          Refusal *refusal) {
    for (size_t i = 0; i < VARYING_COUNT; i++) {
        if (!value_check(&VARIABLES[i], reached[i], refusal)) {
            char step[NUMBER_SIZE], derivative[NUMBER_SIZE], value[NUMBER_SIZE];
            return refuse(
                refusal,
                "doStep: communicationStepSize = %s refused: with its derivative %s, %s reaches %s; must be %s",
                number_text(duration, step), number_text(now->derivatives[i].value, derivative), VARIABLES[i].name,
                number_text(reached[i], value), VARIABLES[i].requirement);
        }
    }
    return true;
}

/* The ramp from `values` on; the rate of the phase is added to the frequency ratio. */
static Ramp ramp_from(const double values[SETTABLE_COUNT], double drive_frequency, const InputDerivative *derivatives) {
    double turning = derivatives[VR_PHASE].value / drive_frequency;
    return (Ramp){values[VR_FREQUENCY_RATIO] + turning, derivatives[VR_LOAD].value,
                  derivatives[VR_FREQUENCY_RATIO].value};
}

/* Prepare the system of a part of the step. */
static bool prepare_part(System *system, Tables *tables, const double values[SETTABLE_COUNT], const Ramp *ramp,
                         double duration, Refusal *refusal) {
    double middle[SETTABLE_COUNT];
    memcpy(middle, values, sizeof middle);
    middle[VR_FREQUENCY_RATIO] = ramp->ratio + 0.5 * ramp->ratio_rate * duration;
    if (!prepare_system(middle, tables, system, refusal)) {
        return false;
    }
    system_ramp(system, ramp, duration);
    return true;
}

/* Give the moment after a ramp of `duration` [s] the phase that belongs to a held frequency `ratio` at drive frequency
 * `w` [rad/s]. */
static void hold_phase(double ratio, double w, const Ramp *ramp, double duration, Moment *after) {
    double added = ramp->ratio * w - ratio * w;
    after->psi = within_turn(after->psi - remainder(added * duration, TAU));
}

bool ramped_step(const System *present, Tables *tables, const Snapshot *now, double duration, Budget *budget,
                 Moment *after, double reached[SETTABLE_COUNT], Refusal *refusal) {
    double values[SETTABLE_COUNT], left = duration, w = present->device.drive_frequency;
    const Motion *motion = present->motion;
    Clock clock = clock_of(duration);
    *after = now->moment;
    grow(now, duration, reached);
    memcpy(values, now->values, sizeof values);
    if (!reached_check(now, reached, duration, refusal)) {
        return false;
    }
    while (left > 0.0) {
        System system;
        Moment before = *after;
        Ramp ramp = ramp_from(values, w, now->derivatives);
        double part = motion->part == NULL ? left : motion->part(&present->device, &ramp, left);
        budget->passed = clock.elapsed;
        if (budget_left(budget, MAX_SLOW_PHASES) == 0) {
            return budget_refuse(budget, 0.0, MAX_SLOW_PHASES, "slow phases of the normal load", refusal);
        }
        if (!prepare_part(&system, tables, values, &ramp, part, refusal) ||
            !motion->advance(&system, &before, part, NULL, budget, after, refusal)) {
            return false;
        }
        left = part == left ? 0.0 : clock_advance(&clock, part);
        budget_spend(budget, left > 0.0, MAX_SLOW_PHASES);
        hold_phase(values[VR_FREQUENCY_RATIO], w, &ramp, part, after);
        grow(now, left > 0.0 ? clock.elapsed : duration, values);
    }
    return true;
}
