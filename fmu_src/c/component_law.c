#include "component_law.h"

#include <math.h>

#include "averaged.h"
#include "constants.h"
#include "refusal_texts.h"
#include "resolved_start.h"
#include "state.h"
#include "values.h"

bool all_finite(const double *numbers, size_t count) {
    for (size_t i = 0; i < count; i++) {
        if (!isfinite(numbers[i])) {
            return false;
        }
    }
    return true;
}

static bool law_is_finite(const Law *law) {
    const TheoryRange theory = theory_range(law);
    const Plant *plant = &law->held.plant;
    const double coefficients[] = {
        plant->total_mass,      plant->mass_fraction,     plant->normal_frequency,
        plant->slip.decay,      plant->slip.stiffness,    plant->stick.decay,
        plant->stick.stiffness, plant->drive.re,          plant->drive.im,
        plant->relative_drive,  plant->base_acceleration, plant->holding_drive.re,
        plant->spring,          plant->damper,            plant->holding_drive.im,
        theory.velocity,        theory.drag,              theory.strongest,
    };
    return all_finite(coefficients, sizeof coefficients / sizeof coefficients[0]);
}

/* Refuse values that together leave the range of floating point numbers; the text names the value that is
 * the most decades away from its start value. */
static bool refuse_extreme(const double values[SETTABLE_COUNT], Refusal *refusal) {
    size_t furthest = 0;
    double largest = -1.0;
    for (size_t i = 0; i < SETTABLE_COUNT; i++) {
        double start = VARIABLES[i].start != 0.0 ? VARIABLES[i].start : 1.0;
        double distance = values[i] != 0.0 ? fabs(log10(fabs(values[i])) - log10(start)) : 0.0;
        if (distance > largest) {
            largest = distance;
            furthest = i;
        }
    }
    char value[NUMBER_SIZE], start[NUMBER_SIZE];
    const Variable *variable = &VARIABLES[furthest];
    return refuse_extreme_value(refusal, variable->name,
                                value_text(variable, values[furthest], value),
                                value_text(variable, variable->start, start));
}

Inputs reduced_inputs(const double values[SETTABLE_COUNT]) {
    Inputs inputs = inputs_of(values);
    inputs.phase = remainder(inputs.phase, TAU);
    return inputs;
}

/* Give a law its `orbits` and the law of the full device (`resolved`) if averages of second order need
 * them. */
static bool prepare_orbits(OrbitTables *orbits, Law *law, Law *resolved, Refusal *refusal) {
    if (law_follows_orbits(law)) {
        Device full = law->device;
        full.fidelity = 2;
        full.tolerance = fmin(full.tolerance, RESOLVED_TOLERANCE);
        if (!law_prepare(resolved, &full, &law->inputs, NULL, refusal)) {
            return false;
        }
        law->resolved = resolved;
        law->orbits = orbits;
    }
    return true;
}

bool prepare_law(const double values[SETTABLE_COUNT], FrictionTable *table, OrbitTables *orbits,
                 Law *law, Law *resolved, Refusal *refusal) {
    Device device = device_of(values);
    Inputs inputs = reduced_inputs(values);
    if (!law_prepare(law, &device, &inputs, table, refusal)) {
        return false;
    }
    if (!law_is_finite(law)) {
        return refuse_extreme(values, refusal);
    }
    return prepare_orbits(orbits, law, resolved, refusal);
}

bool bounded_work_check(const Law *law, double step_size, Refusal *refusal) {
    double frequency = LONGEST_ARC / law->held.arc;
    return law->device.fidelity == 0 || !(step_size * frequency > TAU * MAX_TURNS)
           || refuse_too_many_turns(refusal, step_size, frequency, MAX_TURNS);
}
