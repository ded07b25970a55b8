/* FMI 3.0: get and set values of variables, all of a call or none. */
#include <string.h>

#include "fmi3_api.h"
#include "values.h"

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

fmi3Status fmi3GetFloat64(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                          size_t nValueReferences, fmi3Float64 values[], size_t nValues) {
    Instance *own = instance;
    Refusal refusal;
    unsigned places[VARIABLE_COUNT + 1];
    double found[VARIABLE_COUNT + 1];
    size_t count = 0;
    bool done = call_check(own, "fmi3GetFloat64", valueReferences, nValueReferences, values,
                           nValues, REAL_TYPE, places, &count, &refusal)
                && component_get(&own->component, places, found, count, &refusal);
    const double *next = found;
    for (size_t i = 0; done && i < nValueReferences; i++) {
        bool time = is_time(valueReferences[i], REAL_TYPE);
        values[i] = time ? own->component.now.time : *next++;
    }
    return answer(own, done, &refusal);
}

fmi3Status fmi3GetInt32(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                        size_t nValueReferences, fmi3Int32 values[], size_t nValues) {
    Instance *own = instance;
    Refusal refusal;
    unsigned places[VARIABLE_COUNT + 1];
    double found[VARIABLE_COUNT + 1];
    size_t count = 0;
    bool done = call_check(own, "fmi3GetInt32", valueReferences, nValueReferences, values, nValues,
                           INTEGER_TYPE, places, &count, &refusal)
                && component_get(&own->component, places, found, count, &refusal);
    for (size_t i = 0; done && i < count; i++) {
        values[i] = (fmi3Int32)found[i];
    }
    return answer(own, done, &refusal);
}

fmi3Status fmi3SetFloat64(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                          size_t nValueReferences, const fmi3Float64 values[], size_t nValues) {
    Instance *own = instance;
    Refusal refusal;
    unsigned places[VARIABLE_COUNT + 1];
    size_t count = 0;
    bool done = call_check(own, "fmi3SetFloat64", valueReferences, nValueReferences, values,
                           nValues, REAL_TYPE, places, &count, &refusal);
    if (done && count < nValueReferences) {
        done = refuse(&refusal, "time (valueReference = %d) refused: it is the independent variable "
                      "and cannot be set", TIME_REFERENCE);
    }
    done = done && component_set(&own->component, places, values, count, &refusal);
    return answer(own, done, &refusal);
}

fmi3Status fmi3SetInt32(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                        size_t nValueReferences, const fmi3Int32 values[], size_t nValues) {
    Instance *own = instance;
    Refusal refusal;
    unsigned places[VARIABLE_COUNT + 1];
    double changes[VARIABLE_COUNT + 1];
    size_t count = 0;
    bool done = call_check(own, "fmi3SetInt32", valueReferences, nValueReferences, values, nValues,
                           INTEGER_TYPE, places, &count, &refusal);
    for (size_t i = 0; done && i < count; i++) {
        changes[i] = values[i];
    }
    done = done && component_set(&own->component, places, changes, count, &refusal);
    return answer(own, done, &refusal);
}

/* There are no variables of the other types: only an empty call passes. */
static fmi3Status other_type(fmi3Instance instance, const char *call,
                             const fmi3ValueReference *references, size_t count,
                             const void *values, size_t value_count, ValueType type) {
    Refusal refusal;
    unsigned places[VARIABLE_COUNT + 1];
    size_t found = 0;
    bool done = call_check(instance, call, references, count, values, value_count, type, places,
                           &found, &refusal);
    return answer(instance, done, &refusal);
}

#define OTHER_TYPE(NAME, TYPE) \
    fmi3Status fmi3Get##NAME(fmi3Instance instance, const fmi3ValueReference valueReferences[], \
                             size_t nValueReferences, fmi3##NAME values[], size_t nValues) { \
        return other_type(instance, "fmi3Get" #NAME, valueReferences, nValueReferences, values, \
                          nValues, TYPE); \
    } \
    fmi3Status fmi3Set##NAME(fmi3Instance instance, const fmi3ValueReference valueReferences[], \
                             size_t nValueReferences, const fmi3##NAME values[], \
                             size_t nValues) { \
        return other_type(instance, "fmi3Set" #NAME, valueReferences, nValueReferences, values, \
                          nValues, TYPE); \
    }

OTHER_TYPE(Float32, FLOAT32_TYPE)
OTHER_TYPE(Int8, INT8_TYPE)
OTHER_TYPE(UInt8, UINT8_TYPE)
OTHER_TYPE(Int16, INT16_TYPE)
OTHER_TYPE(UInt16, UINT16_TYPE)
OTHER_TYPE(UInt32, UINT32_TYPE)
OTHER_TYPE(Int64, INT64_TYPE)
OTHER_TYPE(UInt64, UINT64_TYPE)
OTHER_TYPE(Boolean, BOOLEAN_TYPE)
OTHER_TYPE(String, STRING_TYPE)

fmi3Status fmi3GetBinary(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                         size_t nValueReferences, size_t valueSizes[], fmi3Binary values[],
                         size_t nValues) {
    (void)valueSizes;
    return other_type(instance, "fmi3GetBinary", valueReferences, nValueReferences, values, nValues,
                      BINARY_TYPE);
}

fmi3Status fmi3SetBinary(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                         size_t nValueReferences, const size_t valueSizes[],
                         const fmi3Binary values[], size_t nValues) {
    (void)valueSizes;
    return other_type(instance, "fmi3SetBinary", valueReferences, nValueReferences, values, nValues,
                      BINARY_TYPE);
}

fmi3Status fmi3GetClock(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                        size_t nValueReferences, fmi3Clock values[]) {
    return other_type(instance, "fmi3GetClock", valueReferences, nValueReferences, values,
                      nValueReferences, CLOCK_TYPE);
}

fmi3Status fmi3SetClock(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                        size_t nValueReferences, const fmi3Clock values[]) {
    return other_type(instance, "fmi3SetClock", valueReferences, nValueReferences, values,
                      nValueReferences, CLOCK_TYPE);
}
