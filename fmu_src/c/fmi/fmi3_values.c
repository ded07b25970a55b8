/* FMI 3.0: get and set values of variables, all of a call or none. */
#include "../component/values.h"
#include "fmi3_api.h"

/* Of `time`, which is no row of the table. */
enum { TIME_REFERENCE = 1 };

/* Refuse null pointers, numbers of values that do not fit, and more than there are variables. */
static bool count_check(const char *call, const fmi3ValueReference *references, size_t count,
                        const void *values, size_t value_count, Refusal *refusal) {
    if (count > VARIABLE_COUNT + 1) {
        return refuse(refusal, "%s: nValueReferences = %lu refused: must be at most %d, each "
                      "variable once", call, (unsigned long)count, VARIABLE_COUNT + 1);
    }
    if (value_count != count) {
        return refuse(refusal, "%s: nValues = %lu refused: must be %lu, one for each reference",
                      call, (unsigned long)value_count, (unsigned long)count);
    }
    return count == 0 || (references != NULL && values != NULL)
           || refuse(refusal, "%s: a null pointer refused: must point to %lu references or values",
                     call, (unsigned long)count);
}

static bool is_time(fmi3ValueReference reference, ValueType type) {
    return reference == TIME_REFERENCE && type == REAL_TYPE;
}

/* Translate references to places in the table, without the time; refuse those that do not fit, and more
 * of them than the table has. */
static bool places_of(const fmi3ValueReference *references, size_t count, ValueType type,
                      unsigned *places, size_t *place_count, Refusal *refusal) {
    *place_count = 0;
    for (size_t i = 0; i < count; i++) {
        if (references[i] == TIME_REFERENCE && type != REAL_TYPE) {
            return refuse_wrong_type(refusal, "time", TIME_REFERENCE, FMI.type_names[REAL_TYPE],
                                     FMI.type_names[type]);
        }
        if (is_time(references[i], type)) {
            continue;
        }
        unsigned place = references[i] - FMI.reference_offset;
        if (!reference_check(place, type, refusal)) {
            return false;
        }
        places[(*place_count)++] = place;
    }
    return *place_count <= VARIABLE_COUNT
           || refuse(refusal, "valueReferences: %lu variables refused: must be at most %d, each once",
                     (unsigned long)*place_count, VARIABLE_COUNT);
}

/* Check a call and translate its references; refuse what does not fit. */
static bool call_check(const Instance *own, const char *call,
                       const fmi3ValueReference *references, size_t count, const void *values,
                       size_t value_count, ValueType type, unsigned *places, size_t *place_count,
                       Refusal *refusal) {
    return own != NULL && count_check(call, references, count, values, value_count, refusal)
           && places_of(references, count, type, places, place_count, refusal);
}

/* There are no variables but of type Float64 and Int32: of the other types only an empty call passes. */
static fmi3Status get_values(fmi3Instance instance, const char *call,
                             const fmi3ValueReference *references, size_t count, void *values,
                             size_t value_count, ValueType type) {
    Instance *own = instance;
    Refusal refusal;
    unsigned places[VARIABLE_COUNT + 1];
    double found[VARIABLE_COUNT + 1];
    size_t place_count = 0;
    bool done = call_check(own, call, references, count, values, value_count, type, places,
                           &place_count, &refusal)
                && component_get(&own->component, places, found, place_count, &refusal);
    const double *next = found;
    for (size_t i = 0; done && i < count; i++) {
        double value = is_time(references[i], type) ? own->component.now.time : *next++;
        if (type == REAL_TYPE) {
            ((fmi3Float64 *)values)[i] = value;
        } else {
            ((fmi3Int32 *)values)[i] = (fmi3Int32)value;
        }
    }
    return answer(own, done, &refusal);
}

static fmi3Status set_values(fmi3Instance instance, const char *call,
                             const fmi3ValueReference *references, size_t count,
                             const void *values, size_t value_count, ValueType type) {
    Instance *own = instance;
    Refusal refusal;
    unsigned places[VARIABLE_COUNT + 1];
    double changes[VARIABLE_COUNT + 1];
    size_t place_count = 0;
    bool done = call_check(own, call, references, count, values, value_count, type, places,
                           &place_count, &refusal);
    if (done && place_count < count) {
        done = refuse(&refusal, "time (valueReference = %d) refused: it is the independent variable "
                      "and cannot be set", TIME_REFERENCE);
    }
    for (size_t i = 0; done && i < count; i++) {
        changes[i] = type == REAL_TYPE ? ((const fmi3Float64 *)values)[i]
                                       : ((const fmi3Int32 *)values)[i];
    }
    done = done && component_set(&own->component, places, changes, count, &refusal);
    return answer(own, done, &refusal);
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
