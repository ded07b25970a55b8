#include "ramped_step.h"

#include <math.h>
#include <string.h>

#include "angle.h"
#include "clock.h"
#include "values.h"
#include "vibrating_load.h"

/* Slow phases that a whole budget buys. */
enum { MAX_SLOW_PHASES = 1000 };

/* Values after inputs have grown for `t` [s]. */
static void grow(const Snapshot *now, double t, double values[SETTABLE_COUNT]) {
    memcpy(values, now->values, sizeof now->values);
    for (size_t i = 0; i < INPUT_COUNT; i++) {
        values[i] += now->derivatives[i].value * t;
    }
}

/* Refuse inputs out of their bounds at the end of a step of `duration` [s]. */
static bool reached_check(const Snapshot *now, const double reached[SETTABLE_COUNT],
                          double duration, Refusal *refusal) {
    for (size_t i = 0; i < INPUT_COUNT; i++) {
        Refusal bounds;
        if (!value_check(&VARIABLES[i], reached[i], &bounds)) {
            char step[NUMBER_SIZE], derivative[NUMBER_SIZE], value[NUMBER_SIZE];
            return refuse(refusal,
                          "doStep: communicationStepSize = %s refused: with its derivative %s, %s "
                          "reaches %s; must be %s",
                          number_text(duration, step),
                          number_text(now->derivatives[i].value, derivative), VARIABLES[i].name,
                          number_text(reached[i], value), VARIABLES[i].requirement);
        }
    }
    return true;
}

/* The ramp from `values` on; the rate of the phase is added to the frequency ratio. */
static Ramp ramp_from(const double values[SETTABLE_COUNT], const InputDerivative *derivatives) {
    double turning = derivatives[VR_PHASE].value / values[VR_DRIVE_FREQUENCY];
    return (Ramp){values[VR_FREQUENCY_RATIO] + turning, derivatives[VR_LOAD].value,
                  derivatives[VR_FREQUENCY_RATIO].value};
}

/* The part [s] of the time `left` during which averaged motion has one slow phase. */
static double time_of_slow_phase(const double values[SETTABLE_COUNT], const Ramp *ramp,
                                 double left) {
    Device device = device_of(values);
    if (ramp->ratio_rate == 0.0 || device.fidelity != 0 || device.normal_amplitude == 0.0) {
        return left;
    }
    double boundary = next_slow_boundary(&device, ramp->ratio, copysign(1.0, ramp->ratio_rate));
    /* By rounding, a boundary that was reached may be just ahead. */
    double ahead = fmax(fabs(boundary - ramp->ratio), EXACT * fmax(1.0, fabs(ramp->ratio)));
    return fmin(left, ahead / fabs(ramp->ratio_rate));
}

static bool prepare_piece(RampedStep *step, const double values[SETTABLE_COUNT], const Ramp *ramp,
                          double duration, FrictionTable *table, OrbitTables *orbits,
                          Refusal *refusal) {
    double middle[SETTABLE_COUNT];
    memcpy(middle, values, sizeof middle);
    middle[VR_FREQUENCY_RATIO] = ramp->ratio + 0.5 * ramp->ratio_rate * duration;
    if (!prepare_law(middle, table, orbits, &step->law, &step->resolved, refusal)) {
        return false;
    }
    law_ramp(&step->law, ramp, duration);
    if (step->law.resolved != NULL) {
        law_ramp(&step->resolved, ramp, duration);
    }
    return bounded_work_check(&step->law, duration, refusal);
}

/* Give the moment after a ramp the phases that belong to held inputs: `begin` are the values before,
 * `duration` [s] ago, and `end` those now. */
static void settle_phases(const double begin[SETTABLE_COUNT],
                          const double end[SETTABLE_COUNT], const Ramp *ramp, double duration,
                          Moment *after) {
    double w = begin[VR_DRIVE_FREQUENCY];
    double added = ramp->ratio * w - begin[VR_FREQUENCY_RATIO] * w;
    after->psi = within_turn(after->psi - remainder(added * duration, TAU));
    if (after->orbit.stage != AVERAGED) {
        Inputs inputs = reduced_inputs(end);
        after->orbit.under.phase = inputs.phase;
        after->orbit.under.load = inputs.load;
        bool led = added != 0.0 || ramp->ratio_rate != 0.0;
        after->orbit.varied = led ? VARIED_LEAD : VARIED_LOAD;
        after->orbit.loading = ramp->load_rate;
    }
}

bool ramped_step(RampedStep *step, const Snapshot *now, const Law *held, double duration,
                 FrictionTable *table, OrbitTables *orbits, Budget *budget, Moment *after,
                 Refusal *refusal) {
    double values[SETTABLE_COUNT], end[SETTABLE_COUNT], left = duration;
    Clock clock = clock_of(duration);
    *after = now->moment;
    law_settle_error(held, after);
    grow(now, duration, step->reached);
    memcpy(values, now->values, sizeof values);
    if (!reached_check(now, step->reached, duration, refusal)) {
        return false;
    }
    while (left > 0.0) {
        Moment before = *after;
        Ramp ramp = ramp_from(values, now->derivatives);
        double piece = time_of_slow_phase(values, &ramp, left);
        budget->passed = clock.elapsed;
        if (budget_left(budget, MAX_SLOW_PHASES) == 0) {
            return budget_refuse(budget, 0.0, MAX_SLOW_PHASES, "slow phases of the normal load",
                                 refusal);
        }
        if (!prepare_piece(step, values, &ramp, piece, table, orbits, refusal)
            || !law_advance(&step->law, &before, piece, NULL, budget, after, refusal)) {
            return false;
        }
        left = piece == left ? 0.0 : clock_advance(&clock, piece);
        budget_spend(budget, left > 0.0, MAX_SLOW_PHASES);
        grow(now, left > 0.0 ? clock.elapsed : duration, end);
        settle_phases(values, end, &ramp, piece, after);
        memcpy(values, end, sizeof values);
    }
    return true;
}
