/* Checks of value references and of the values that a host sets. */
#ifndef SLIDER_VALUES_H
#define SLIDER_VALUES_H

#include <stdbool.h>

#include "lifecycle.h"
#include "refusal.h"
#include "variables.h"

typedef enum { REAL_TYPE, INTEGER_TYPE, BOOLEAN_TYPE, STRING_TYPE } ValueType;

/* Refuses a reference that is unknown, or of a variable of another type. */
bool reference_check(unsigned reference, ValueType type, Refusal *refusal);

/* Refuses a value that the table does not allow. */
bool value_check(const Variable *variable, double value, Refusal *refusal);

/* Refuses to set outputs, fixed parameters while running, anything after the end, and values that
 * the table does not allow. */
bool setting_check(Lifecycle lifecycle, unsigned reference, double value, Refusal *refusal);

/* The value as it is shown in messages: integers without a point. Returns `text`. */
const char *value_text(const Variable *variable, double value, char text[NUMBER_SIZE]);

#endif
