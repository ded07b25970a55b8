/* FMI 2.0: get and set values of variables, all of a call or none. */
#include "../component/values.h"
#include "fmi2_api.h"

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

/* There are no variables but of type Real and Integer: of the other types only an empty call passes. */
static fmi2Status get_values(fmi2Component c, const char *call, const fmi2ValueReference *vr,
                             size_t nvr, void *values, ValueType type) {
    Instance *instance = c;
    Refusal refusal;
    double found[VARIABLE_COUNT];
    bool done = instance != NULL && references_check(call, vr, nvr, values, type, &refusal)
                && component_get(&instance->component, vr, found, nvr, &refusal);
    for (size_t i = 0; done && i < nvr; i++) {
        if (type == REAL_TYPE) {
            ((fmi2Real *)values)[i] = found[i];
        } else {
            ((fmi2Integer *)values)[i] = (fmi2Integer)found[i];
        }
    }
    return answer(instance, done, &refusal);
}

static fmi2Status set_values(fmi2Component c, const char *call, const fmi2ValueReference *vr,
                             size_t nvr, const void *values, ValueType type) {
    Instance *instance = c;
    Refusal refusal;
    double changes[VARIABLE_COUNT];
    bool done = instance != NULL && references_check(call, vr, nvr, values, type, &refusal);
    for (size_t i = 0; done && i < nvr; i++) {
        changes[i] = type == REAL_TYPE ? ((const fmi2Real *)values)[i]
                                       : ((const fmi2Integer *)values)[i];
    }
    done = done && component_set(&instance->component, vr, changes, nvr, &refusal);
    return answer(instance, done, &refusal);
}

#define GET_AND_SET(NAME, TYPE) \
    fmi2Status fmi2Get##NAME(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, \
                             fmi2##NAME value[]) { \
        return get_values(c, "fmi2Get" #NAME, vr, nvr, (void *)value, TYPE); \
    } \
    fmi2Status fmi2Set##NAME(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, \
                             const fmi2##NAME value[]) { \
        return set_values(c, "fmi2Set" #NAME, vr, nvr, (const void *)value, TYPE); \
    }

GET_AND_SET(Real, REAL_TYPE)
GET_AND_SET(Integer, INTEGER_TYPE)
GET_AND_SET(Boolean, BOOLEAN_TYPE)
GET_AND_SET(String, STRING_TYPE)
