#include "input_derivatives.h"

#include <math.h>
#include <stdio.h>

#include "variables.h"

bool inputs_vary(const InputDerivative derivatives[VARYING_COUNT]) {
    for (size_t i = 0; i < VARYING_COUNT; i++) {
        if (derivatives[i].value != 0.0) {
            return true;
        }
    }
    return false;
}

static bool derivative_check(Lifecycle lifecycle, unsigned reference, double value, Refusal *refusal) {
    const char *name = VARIABLES[reference].name;
    char text[NUMBER_SIZE], call[REFUSAL_SIZE];
    bool is_held = reference == VR_AMPLITUDE_DEVIATION || reference == VR_FREQUENCY_DEVIATION;
    if (reference >= VARYING_COUNT && !is_held) {
        return refuse(refusal, "derivative of %s = %s refused: it is no input; must be of %s, %s or %s", name,
                      number_text(value, text), VARIABLES[0].name, VARIABLES[1].name, VARIABLES[2].name);
    }
    if (lifecycle == TERMINATED) {
        snprintf(call, sizeof call, "setting the derivative of %s", name);
        return require(call, lifecycle, STEP_COMPLETE, refusal);
    }
    if (is_held) {
        return value == 0.0 ||
               refuse(refusal, "derivative of %s = %s refused: the input is held over a step; must be 0", name,
                      number_text(value, text));
    }
    return isfinite(value) ||
           refuse(refusal, "derivative of %s = %s refused: must be a finite number", name, number_text(value, text));
}

bool change_derivatives(InputDerivative derivatives[VARYING_COUNT], Lifecycle lifecycle, const unsigned *references,
                        const double *values, size_t count, Refusal *refusal) {
    for (size_t i = 0; i < count; i++) {
        if (!derivative_check(lifecycle, references[i], values[i], refusal)) {
            return false;
        }
    }
    for (size_t i = 0; i < count; i++) {
        if (references[i] < VARYING_COUNT) {
            derivatives[references[i]] = (InputDerivative){values[i], 1.0};
        }
    }
    return true;
}

void hold_inputs(InputDerivative derivatives[VARYING_COUNT], const unsigned *references, size_t count) {
    for (size_t i = 0; i < count; i++) {
        if (references[i] < VARYING_COUNT && derivatives[references[i]].is_new == 0.0) {
            derivatives[references[i]].value = 0.0;
        }
    }
}

void derivatives_used(InputDerivative derivatives[VARYING_COUNT]) {
    for (size_t i = 0; i < VARYING_COUNT; i++) {
        derivatives[i].is_new = 0.0;
    }
}
