#include "ramped_step.h"

#include <math.h>
#include <string.h>

#include "angle.h"
#include "values.h"

/* Refuse a step in which an input leaves its bounds. */
static bool refuse_reached(const Variable *variable, double derivative, double reached,
                           double duration, Refusal *refusal) {
    char step[NUMBER_SIZE], rate[NUMBER_SIZE], value[NUMBER_SIZE];
    return refuse(refusal,
                  "doStep: communicationStepSize = %s refused: with its derivative %s %s reaches %s; "
                  "must be %s",
                  number_text(duration, step), number_text(derivative, rate), variable->name,
                  number_text(reached, value), variable->requirement);
}

static bool reach(RampedStep *step, const Snapshot *now, double duration, Refusal *refusal) {
    memcpy(step->reached, now->values, sizeof step->reached);
    for (size_t i = 0; i < INPUT_COUNT; i++) {
        double derivative = now->derivatives[i].value;
        step->reached[i] += derivative * duration;
        Refusal bounds;
        if (!value_check(&VARIABLES[i], step->reached[i], &bounds)) {
            return refuse_reached(&VARIABLES[i], derivative, step->reached[i], duration, refusal);
        }
    }
    return true;
}

bool ramped_step_prepare(RampedStep *step, const Snapshot *now, double duration,
                         FrictionTable *table, OrbitTables *orbits, Refusal *refusal) {
    double values[SETTABLE_COUNT];
    memcpy(values, now->values, sizeof values);
    double w = values[VR_DRIVE_FREQUENCY];
    values[VR_FREQUENCY_RATIO] += now->derivatives[VR_PHASE].value / w;
    if (!reach(step, now, duration, refusal)
        || !prepare_law(values, table, orbits, &step->law, &step->resolved, refusal)) {
        return false;
    }
    if (step->law.device.fidelity == 0) {
        return refuse(refusal, "doStep: inputs that vary refused: fidelity must be 1 or 2");
    }
    double load_rate = now->derivatives[VR_LOAD].value;
    double normal_rate = now->derivatives[VR_FREQUENCY_RATIO].value * w;
    law_ramp(&step->law, load_rate, normal_rate, duration);
    if (step->law.resolved != NULL) {
        law_ramp(&step->resolved, load_rate, normal_rate, duration);
    }
    return true;
}

void ramped_step_finish(const RampedStep *step, const Law *held, double duration, Moment *after) {
    double added = step->law.held.plant.normal_frequency - held->held.plant.normal_frequency;
    Inputs reached = reduced_inputs(step->reached);
    after->psi = within_turn(after->psi - remainder(added * duration, TAU));
    after->orbit.under.phase = reached.phase;
    after->orbit.under.load = reached.load;
}
