#include "input_derivatives.h"

#include <math.h>
#include <stdio.h>

#include "variables.h"

bool inputs_vary(const InputDerivative derivatives[INPUT_COUNT]) {
    for (size_t i = 0; i < INPUT_COUNT; i++) {
        if (derivatives[i].value != 0.0) {
            return true;
        }
    }
    return false;
}

static bool derivative_check(Lifecycle lifecycle, unsigned reference, double value,
                             Refusal *refusal) {
    const char *name = VARIABLES[reference].name;
    char text[NUMBER_SIZE], call[REFUSAL_SIZE];
    if (reference >= INPUT_COUNT) {
        return refuse(refusal, "derivative of %s = %s refused: it is no input; must be of %s, %s or %s",
                      name, number_text(value, text), VARIABLES[0].name, VARIABLES[1].name,
                      VARIABLES[2].name);
    }
    if (lifecycle == TERMINATED) {
        snprintf(call, sizeof call, "setting the derivative of %s", name);
        return require(call, lifecycle, STEP_COMPLETE, refusal);
    }
    return isfinite(value)
           || refuse(refusal, "derivative of %s = %s refused: must be a finite number", name,
                     number_text(value, text));
}

bool change_derivatives(InputDerivative derivatives[INPUT_COUNT], Lifecycle lifecycle,
                        const unsigned *references, const double *values, size_t count,
                        Refusal *refusal) {
    for (size_t i = 0; i < count; i++) {
        if (!derivative_check(lifecycle, references[i], values[i], refusal)) {
            return false;
        }
        derivatives[references[i]] = (InputDerivative){values[i], true};
    }
    return true;
}

void hold_inputs(InputDerivative derivatives[INPUT_COUNT], const unsigned *references,
                 size_t count) {
    for (size_t i = 0; i < count; i++) {
        if (references[i] < INPUT_COUNT && !derivatives[references[i]].is_new) {
            derivatives[references[i]].value = 0.0;
        }
    }
}

void derivatives_used(InputDerivative derivatives[INPUT_COUNT]) {
    for (size_t i = 0; i < INPUT_COUNT; i++) {
        derivatives[i].is_new = false;
    }
}
