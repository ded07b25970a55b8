/* FMI 3.0: get and set values of variables, all of a call or none. */
#include "fmi3_api.h"
#include "value_access.h"

/* Refuse a number of values that does not fit the references. */
static fmi3Status refuse_value_count(fmi3Instance instance, const char *call, size_t count,
                                     size_t value_count) {
    Refusal refusal;
    refuse(&refusal, "%s: nValues = %lu refused: must be %lu, one for each reference", call,
           (unsigned long)value_count, (unsigned long)count);
    return answer(instance, false, &refusal);
}

static fmi3Status get_values(fmi3Instance instance, const char *call,
                             const fmi3ValueReference *references, size_t count, void *values,
                             size_t value_count, ValueType type) {
    return value_count != count ? refuse_value_count(instance, call, count, value_count)
                                : (fmi3Status)values_get(instance, call, references, count, values, type);
}

static fmi3Status set_values(fmi3Instance instance, const char *call,
                             const fmi3ValueReference *references, size_t count,
                             const void *values, size_t value_count, ValueType type) {
    return value_count != count ? refuse_value_count(instance, call, count, value_count)
                                : (fmi3Status)values_set(instance, call, references, count, values, type);
}

#define GET_AND_SET(NAME, TYPE) \
    fmi3Status fmi3Get##NAME(fmi3Instance instance, const fmi3ValueReference valueReferences[], \
                             size_t nValueReferences, fmi3##NAME values[], size_t nValues) { \
        return get_values(instance, "fmi3Get" #NAME, valueReferences, nValueReferences, \
                          (void *)values, nValues, TYPE); \
    } \
    fmi3Status fmi3Set##NAME(fmi3Instance instance, const fmi3ValueReference valueReferences[], \
                             size_t nValueReferences, const fmi3##NAME values[], \
                             size_t nValues) { \
        return set_values(instance, "fmi3Set" #NAME, valueReferences, nValueReferences, \
                          (const void *)values, nValues, TYPE); \
    }

GET_AND_SET(Float64, REAL_TYPE)
GET_AND_SET(Int32, INTEGER_TYPE)
GET_AND_SET(Float32, FLOAT32_TYPE)
GET_AND_SET(Int8, INT8_TYPE)
GET_AND_SET(UInt8, UINT8_TYPE)
GET_AND_SET(Int16, INT16_TYPE)
GET_AND_SET(UInt16, UINT16_TYPE)
GET_AND_SET(UInt32, UINT32_TYPE)
GET_AND_SET(Int64, INT64_TYPE)
GET_AND_SET(UInt64, UINT64_TYPE)
GET_AND_SET(Boolean, BOOLEAN_TYPE)
GET_AND_SET(String, STRING_TYPE)

fmi3Status fmi3GetBinary(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                         size_t nValueReferences, size_t valueSizes[], fmi3Binary values[],
                         size_t nValues) {
    (void)valueSizes;
    return get_values(instance, "fmi3GetBinary", valueReferences, nValueReferences,
                      (void *)values, nValues, BINARY_TYPE);
}

fmi3Status fmi3SetBinary(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                         size_t nValueReferences, const size_t valueSizes[],
                         const fmi3Binary values[], size_t nValues) {
    (void)valueSizes;
    return set_values(instance, "fmi3SetBinary", valueReferences, nValueReferences,
                      (const void *)values, nValues, BINARY_TYPE);
}

fmi3Status fmi3GetClock(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                        size_t nValueReferences, fmi3Clock values[]) {
    return get_values(instance, "fmi3GetClock", valueReferences, nValueReferences,
                      (void *)values, nValueReferences, CLOCK_TYPE);
}

fmi3Status fmi3SetClock(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                        size_t nValueReferences, const fmi3Clock values[]) {
    return set_values(instance, "fmi3SetClock", valueReferences, nValueReferences,
                      (const void *)values, nValueReferences, CLOCK_TYPE);
}
