/* FMI 2.0: getting and setting values of variables, all of a call or none. */
#include "instance.h"
#include "values.h"

/* Refuses null pointers, more values than there are variables, and references that do not fit. */
static bool references_check(const char *call, const fmi2ValueReference *references, size_t count,
                             const void *values, ValueType type, Refusal *refusal) {
    if (count > VARIABLE_COUNT) {
        return refuse(refusal, "%s: nvr = %lu refused: allowed is up to %d, each variable once",
                      call, (unsigned long)count, VARIABLE_COUNT);
    }
    if (count > 0 && (references == NULL || values == NULL)) {
        return refuse(refusal, "%s: a null pointer refused: allowed are %lu value references and "
                      "values", call, (unsigned long)count);
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
    if (instance == NULL) {
        return fmi2Error;
    }
    bool done = references_check("fmi2GetReal", vr, nvr, value, REAL_TYPE, &refusal)
                && component_get(&instance->component, vr, value, nvr, &refusal);
    return answer(instance, done, &refusal);
}

fmi2Status fmi2GetInteger(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                          fmi2Integer value[]) {
    Instance *instance = c;
    Refusal refusal;
    double found[VARIABLE_COUNT];
    if (instance == NULL) {
        return fmi2Error;
    }
    bool done = references_check("fmi2GetInteger", vr, nvr, value, INTEGER_TYPE, &refusal)
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
    if (instance == NULL) {
        return fmi2Error;
    }
    bool done = references_check("fmi2SetReal", vr, nvr, value, REAL_TYPE, &refusal)
                && component_set(&instance->component, vr, value, nvr, &refusal);
    return answer(instance, done, &refusal);
}

fmi2Status fmi2SetInteger(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                          const fmi2Integer value[]) {
    Instance *instance = c;
    Refusal refusal;
    double wanted[VARIABLE_COUNT];
    if (instance == NULL) {
        return fmi2Error;
    }
    bool done = references_check("fmi2SetInteger", vr, nvr, value, INTEGER_TYPE, &refusal);
    for (size_t i = 0; done && i < nvr; i++) {
        wanted[i] = value[i];
    }
    done = done && component_set(&instance->component, vr, wanted, nvr, &refusal);
    return answer(instance, done, &refusal);
}

/* There are no variables of the other types, so the check of references is all that is left. */
static fmi2Status no_such_values(fmi2Component c, const char *call, const fmi2ValueReference *vr,
                                 size_t nvr, const void *values, ValueType type) {
    const Instance *instance = c;
    Refusal refusal;
    if (instance == NULL) {
        return fmi2Error;
    }
    return answer(instance, references_check(call, vr, nvr, values, type, &refusal), &refusal);
}

fmi2Status fmi2GetBoolean(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                          fmi2Boolean value[]) {
    return no_such_values(c, "fmi2GetBoolean", vr, nvr, value, BOOLEAN_TYPE);
}

fmi2Status fmi2GetString(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                         fmi2String value[]) {
    return no_such_values(c, "fmi2GetString", vr, nvr, value, STRING_TYPE);
}

fmi2Status fmi2SetBoolean(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                          const fmi2Boolean value[]) {
    return no_such_values(c, "fmi2SetBoolean", vr, nvr, value, BOOLEAN_TYPE);
}

fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                         const fmi2String value[]) {
    return no_such_values(c, "fmi2SetString", vr, nvr, value, STRING_TYPE);
}
