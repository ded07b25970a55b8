#include "value_access.h"

/* Whether it is the reference of the time, a variable of FMI 3.0 that is no row of the table. */
static bool is_time(unsigned reference) {
    return reference >= FMI.min_reference && reference < FMI.reference_offset;
}

/* Refuse more references than there are variables. */
static bool count_check(const char *call, size_t count, int most, Refusal *refusal) {
    return count <= (size_t)most || refuse(refusal, "%s: %s = %lu refused: must be at most %d, each variable once",
                                           call, FMI.count_name, (unsigned long)count, most);
}

/* Refuse a place in the table where no variable is, or one of another type. */
static bool reference_check(unsigned place, ValueType type, Refusal *refusal) {
    unsigned reference = place + FMI.reference_offset;
    if (place >= VARIABLE_COUNT) {
        return refuse_unknown_reference(refusal, reference, FMI.min_reference,
                                        VARIABLE_COUNT - 1 + FMI.reference_offset);
    }
    const Variable *variable = &VARIABLES[place];
    ValueType own = variable->integer ? INTEGER_TYPE : REAL_TYPE;
    return own == type ||
           refuse_wrong_type(refusal, variable->name, reference, FMI.type_names[own], FMI.type_names[type]);
}

bool places_check(const char *call, const unsigned *references, size_t count, const void *values, ValueType type,
                  unsigned *places, size_t *place_count, Refusal *refusal) {
    *place_count = 0;
    if (!count_check(call, count, VARIABLE_COUNT + is_time(FMI.min_reference), refusal)) {
        return false;
    }
    if (count > 0 && (references == NULL || values == NULL)) {
        return refuse(refusal, "%s: a null pointer refused: must point to %lu references or values", call,
                      (unsigned long)count);
    }
    for (size_t i = 0; i < count; i++) {
        if (is_time(references[i]) && type != REAL_TYPE) {
            return refuse_wrong_type(refusal, "time", references[i], FMI.type_names[REAL_TYPE], FMI.type_names[type]);
        }
        if (!is_time(references[i])) {
            unsigned place = references[i] - FMI.reference_offset;
            if (!reference_check(place, type, refusal)) {
                return false;
            }
            places[(*place_count)++] = place;
        }
    }
    return count_check(call, *place_count, VARIABLE_COUNT, refusal);
}

/* Refuse a number of values that does not fit the references; only FMI 3.0 passes it. */
static bool value_count_check(const char *call, size_t count, size_t value_count, Refusal *refusal) {
    return value_count == count || refuse(refusal, "%s: nValues = %lu refused: must be %lu, one for each reference",
                                          call, (unsigned long)value_count, (unsigned long)count);
}

Status values_get(Instance *instance, const char *call, const unsigned *references, size_t count, void *values,
                  size_t value_count, ValueType type) {
    Refusal refusal;
    unsigned places[VARIABLE_COUNT + 1];
    double found[VARIABLE_COUNT];
    size_t place_count;
    bool done = instance != NULL && value_count_check(call, count, value_count, &refusal) &&
                places_check(call, references, count, values, type, places, &place_count, &refusal) &&
                component_get(&instance->component, places, found, place_count, &refusal);
    const double *next = found;
    for (size_t i = 0; done && i < count; i++) {
        double value = is_time(references[i]) ? instance->component.now.time : *next++;
        if (type == REAL_TYPE) {
            ((double *)values)[i] = value;
        } else {
            ((int *)values)[i] = (int)value;
        }
    }
    return answer(instance, done, &refusal);
}

Status values_set(Instance *instance, const char *call, const unsigned *references, size_t count, const void *values,
                  size_t value_count, ValueType type) {
    Refusal refusal;
    unsigned places[VARIABLE_COUNT + 1];
    double changes[VARIABLE_COUNT];
    size_t place_count;
    bool done = instance != NULL && value_count_check(call, count, value_count, &refusal) &&
                places_check(call, references, count, values, type, places, &place_count, &refusal);
    if (done && place_count < count) {
        done = refuse(&refusal, "time (valueReference = %u) refused: it is the independent variable and cannot be set",
                      FMI.min_reference);
    }
    for (size_t i = 0; done && i < count; i++) {
        changes[i] = type == REAL_TYPE ? ((const double *)values)[i] : ((const int *)values)[i];
    }
    done = done && component_set(&instance->component, places, changes, count, &refusal);
    return answer(instance, done, &refusal);
}
