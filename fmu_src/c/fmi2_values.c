/* FMI 2.0: get and set values of variables, all of a call or none. */
#include "fmi2_api.h"
#include "values.h"

bool references_check(const char *call, const fmi2ValueReference *references, size_t count,
                      const void *values, ValueType type, Refusal *refusal) {
    if (count > VARIABLE_COUNT) {
        return refuse(refusal, "%s: nvr = %lu refused: must be at most %d, each variable once", call,
                      (unsigned long)count, VARIABLE_COUNT);
    }
    if (count > 0 && (references == NULL || values == NULL)) {
        return refuse(refusal, "%s: a null pointer refused: must point to %lu references or values",
                      call, (unsigned long)count);
    }
    for (size_t i = 0; i < count; i++) {
        if (!reference_check(references[i], type, refusal)) {
            return false;
        }
    }
    return true;
}

fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                       fmi2Real value[]) {
    Instance *instance = c;
    Refusal refusal;
    bool done = instance != NULL
                && references_check("fmi2GetReal", vr, nvr, value, REAL_TYPE, &refusal)
                && component_get(&instance->component, vr, value, nvr, &refusal);
    return answer(instance, done, &refusal);
}

fmi2Status fmi2GetInteger(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                          fmi2Integer value[]) {
    Instance *instance = c;
    Refusal refusal;
    double found[VARIABLE_COUNT];
    bool done = instance != NULL
                && references_check("fmi2GetInteger", vr, nvr, value, INTEGER_TYPE, &refusal)
                && component_get(&instance->component, vr, found, nvr, &refusal);
    for (size_t i = 0; done && i < nvr; i++) {
        value[i] = (fmi2Integer)found[i];
    }
    return answer(instance, done, &refusal);
}

fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                       const fmi2Real value[]) {
    Instance *instance = c;
    Refusal refusal;
    bool done = instance != NULL
                && references_check("fmi2SetReal", vr, nvr, value, REAL_TYPE, &refusal)
                && component_set(&instance->component, vr, value, nvr, &refusal);
    return answer(instance, done, &refusal);
}

fmi2Status fmi2SetInteger(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                          const fmi2Integer value[]) {
    Instance *instance = c;
    Refusal refusal;
    double changes[VARIABLE_COUNT];
    bool done = instance != NULL
                && references_check("fmi2SetInteger", vr, nvr, value, INTEGER_TYPE, &refusal);
    for (size_t i = 0; done && i < nvr; i++) {
        changes[i] = value[i];
    }
    done = done && component_set(&instance->component, vr, changes, nvr, &refusal);
    return answer(instance, done, &refusal);
}

/* There are no variables of the other types: only an empty call passes. */
static fmi2Status other_type(fmi2Component c, const char *call, const fmi2ValueReference *vr,
                             size_t nvr, const void *values, ValueType type) {
    Refusal refusal;
    bool done = c != NULL && references_check(call, vr, nvr, values, type, &refusal);
    return answer(c, done, &refusal);
}

fmi2Status fmi2GetBoolean(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                          fmi2Boolean value[]) {
    return other_type(c, "fmi2GetBoolean", vr, nvr, value, BOOLEAN_TYPE);
}

fmi2Status fmi2GetString(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                         fmi2String value[]) {
    return other_type(c, "fmi2GetString", vr, nvr, value, STRING_TYPE);
}

fmi2Status fmi2SetBoolean(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                          const fmi2Boolean value[]) {
    return other_type(c, "fmi2SetBoolean", vr, nvr, value, BOOLEAN_TYPE);
}

fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                         const fmi2String value[]) {
    return other_type(c, "fmi2SetString", vr, nvr, value, STRING_TYPE);
}
