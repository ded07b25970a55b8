#include "values.h"

#include <math.h>
#include <stdio.h>

static const char *type_name(ValueType type) {
    static const char *const NAMES[] = {"Real", "Integer", "Boolean", "String"};
    return NAMES[type];
}

bool reference_check(unsigned reference, ValueType type, Refusal *refusal) {
    if (reference >= VARIABLE_COUNT) {
        return refuse(refusal, "valueReference = %u refused: allowed is 0 to %d", reference,
                      VARIABLE_COUNT - 1);
    }
    const Variable *variable = &VARIABLES[reference];
    ValueType own = variable->integer ? INTEGER_TYPE : REAL_TYPE;
    return own == type
           || refuse(refusal, "%s (valueReference = %u) refused: its type is %s, not %s",
                     variable->name, reference, type_name(own), type_name(type));
}

bool value_check(const Variable *variable, double value, Refusal *refusal) {
    if (isfinite(value) && value >= variable->minimum && value <= variable->maximum
        && (!variable->integer || value == floor(value))) {
        return true;
    }
    char text[NUMBER_SIZE];
    return refuse(refusal, "%s = %s refused: allowed is %s", variable->name,
                  value_text(variable, value, text), variable->allowed);
}

bool setting_check(Lifecycle lifecycle, unsigned reference, double value, Refusal *refusal) {
    const Variable *variable = &VARIABLES[reference];
    char text[NUMBER_SIZE];
    if (lifecycle == TERMINATED) {
        return refuse(refusal, "setting %s refused in state '%s': allowed in '%s'", variable->name,
                      lifecycle_name(TERMINATED), lifecycle_name(STEP_COMPLETE));
    }
    if (reference >= SETTABLE_COUNT) {
        return refuse(refusal, "%s = %s refused: it is an output and cannot be set",
                      variable->name, value_text(variable, value, text));
    }
    if (variable->fixed && lifecycle == STEP_COMPLETE) {
        return refuse(refusal, "%s = %s refused: it is fixed and can be set only before "
                      "initialization ends", variable->name, value_text(variable, value, text));
    }
    return value_check(variable, value, refusal);
}

const char *value_text(const Variable *variable, double value, char text[NUMBER_SIZE]) {
    if (variable->integer && value == floor(value) && fabs(value) < 1e15) {
        snprintf(text, NUMBER_SIZE, "%.0f", value);
        return text;
    }
    return number_text(value, text);
}
