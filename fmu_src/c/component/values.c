#include "values.h"

#include <math.h>
#include <stdio.h>

bool value_check(const Variable *variable, double value, Refusal *refusal) {
    if (isfinite(value) && value >= variable->minimum && value <= variable->maximum &&
        (!variable->integer || value == floor(value))) {
        return true;
    }
    char text[NUMBER_SIZE];
    return refuse_out_of_bounds(refusal, variable->name, value_text(variable, value, text), variable->requirement);
}

/* Refuse the `access` to a variable in any state but `required`. */
static bool require_for(const char *access, unsigned reference, Lifecycle lifecycle, Lifecycle required,
                        Refusal *refusal) {
    char call[REFUSAL_SIZE];
    snprintf(call, sizeof call, "%s %s", access, VARIABLES[reference].name);
    return require(call, lifecycle, required, refusal);
}

bool reading_check(Lifecycle lifecycle, unsigned reference, Refusal *refusal) {
    return reference < SETTABLE_COUNT || lifecycle != INSTANTIATED ||
           require_for("reading", reference, lifecycle, INITIALIZATION, refusal);
}

/* Refuse to set outputs, fixed parameters while running, anything after the end, and values that the table excludes. */
static bool setting_check(Lifecycle lifecycle, unsigned reference, double value, Refusal *refusal) {
    const Variable *variable = &VARIABLES[reference];
    char text[NUMBER_SIZE];
    if (lifecycle == TERMINATED) {
        return require_for("setting", reference, lifecycle, STEP_COMPLETE, refusal);
    }
    if (reference >= SETTABLE_COUNT) {
        return refuse_output_set(refusal, variable->name, value_text(variable, value, text));
    }
    if (variable->fixed && is_running(lifecycle)) {
        return refuse_fixed_while_running(refusal, variable->name, value_text(variable, value, text));
    }
    return value_check(variable, value, refusal);
}

void start_values(double values[SETTABLE_COUNT]) {
    for (size_t i = 0; i < SETTABLE_COUNT; i++) {
        values[i] = VARIABLES[i].start;
    }
}

bool change_values(double values[SETTABLE_COUNT], Lifecycle lifecycle, const unsigned *references,
                   const double *changes, size_t count, Refusal *refusal) {
    for (size_t i = 0; i < count; i++) {
        if (!setting_check(lifecycle, references[i], changes[i], refusal)) {
            return false;
        }
        values[references[i]] = changes[i];
    }
    return true;
}

const char *value_text(const Variable *variable, double value, char text[NUMBER_SIZE]) {
    if (variable->integer && value == floor(value) && fabs(value) < 1e15) {
        snprintf(text, NUMBER_SIZE, "%.0f", value);
        return text;
    }
    return number_text(value, text);
}
