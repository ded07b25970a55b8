/* FMI 2.0: get and set values of variables, all of a call or none. */
#include "fmi2_api.h"
#include "value_access.h"

#define GET_AND_SET(NAME, TYPE) \
    fmi2Status fmi2Get##NAME(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, \
                             fmi2##NAME value[]) { \
        return (fmi2Status)values_get(c, "fmi2Get" #NAME, vr, nvr, (void *)value, TYPE); \
    } \
    fmi2Status fmi2Set##NAME(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, \
                             const fmi2##NAME value[]) { \
        return (fmi2Status)values_set(c, "fmi2Set" #NAME, vr, nvr, (const void *)value, TYPE); \
    }

GET_AND_SET(Real, REAL_TYPE)
GET_AND_SET(Integer, INTEGER_TYPE)
GET_AND_SET(Boolean, BOOLEAN_TYPE)
GET_AND_SET(String, STRING_TYPE)
