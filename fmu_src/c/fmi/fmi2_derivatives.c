/* FMI 2.0 for co-simulation: first derivatives of inputs and outputs, all of a call or none. */
#include "fmi2_api.h"
#include "value_access.h"

/* Refuse what is no call for Reals, and any order but 1. */
static bool derivatives_check(const char *call, const fmi2ValueReference *references, size_t count,
                              const fmi2Integer *orders, const void *values, unsigned *places, Refusal *refusal) {
    if (!places_check(call, references, count, values, REAL_TYPE, places, &count, refusal)) {
        return false;
    }
    if (count > 0 && orders == NULL) {
        return refuse(refusal, "%s: a null pointer refused: must point to %lu orders", call, (unsigned long)count);
    }
    for (size_t i = 0; i < count; i++) {
        if (orders[i] != 1) {
            return refuse(refusal, "%s: derivative of %s of order %d refused: the order must be 1", call,
                          VARIABLES[places[i]].name, (int)orders[i]);
        }
    }
    return true;
}

fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                                       const fmi2Integer order[], const fmi2Real value[]) {
    Instance *instance = c;
    Refusal refusal;
    unsigned places[VARIABLE_COUNT + 1];
    bool done = instance != NULL &&
                derivatives_check("fmi2SetRealInputDerivatives", vr, nvr, order, value, places, &refusal) &&
                component_set_derivatives(&instance->component, places, value, nvr, &refusal);
    return answer(instance, done, &refusal);
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                                        const fmi2Integer order[], fmi2Real value[]) {
    Instance *instance = c;
    Refusal refusal;
    unsigned places[VARIABLE_COUNT + 1];
    bool done = instance != NULL &&
                derivatives_check("fmi2GetRealOutputDerivatives", vr, nvr, order, value, places, &refusal) &&
                component_get_derivatives(&instance->component, places, value, nvr, &refusal);
    return answer(instance, done, &refusal);
}
