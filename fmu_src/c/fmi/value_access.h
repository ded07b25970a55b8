/* Values of variables as FMI hands them over, whatever its version: all of a call or none. `call` is the name of the
 * FMI function, for refusals. */
#pragma once

#include "../component/values.h"
#include "instance.h"

/* Refuse null pointers, more values than there are variables, and references that do not fit. `places` in the table,
 * for VARIABLE_COUNT + 1, are those of the references but for the time, which FMI 3.0 lists as a variable. */
bool places_check(const char *call, const unsigned *references, size_t count, const void *values, ValueType type,
                  unsigned *places, size_t *place_count, Refusal *refusal);

/* Get or set values of a type, one for each reference: otherwise the call is refused. There are no variables but of the
 * first two types: of the others only an empty call passes. */
Status values_get(Instance *instance, const char *call, const unsigned *references, size_t count, void *values,
                  size_t value_count, ValueType type);
Status values_set(Instance *instance, const char *call, const unsigned *references, size_t count, const void *values,
                  size_t value_count, ValueType type);
