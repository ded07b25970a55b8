/* The states of FMI co-simulation, which call needs which, and the names that differ between versions of FMI. */
#pragma once

#include "../base/refusal_texts.h"

/* STEP_COMPLETE of FMI 2.0 is the step mode of FMI 3.0; only FMI 3.0 has EVENT_MODE. */
typedef enum { INSTANTIATED, INITIALIZATION, STEP_COMPLETE, TERMINATED, EVENT_MODE, LIFECYCLES } Lifecycle;

/* Types of values; the table of variables has those of the first two. */
typedef enum {
    REAL_TYPE,
    INTEGER_TYPE,
    BOOLEAN_TYPE,
    STRING_TYPE,
    FLOAT32_TYPE,
    INT8_TYPE,
    UINT8_TYPE,
    INT16_TYPE,
    UINT16_TYPE,
    UINT32_TYPE,
    INT64_TYPE,
    UINT64_TYPE,
    VALUE_TYPES
} ValueType;

/* The value reference of a variable is its place in the table plus `reference_offset`; `min_reference` is the lowest
 * one. */
typedef struct {
    unsigned min_reference, reference_offset;
    const char *state_names[LIFECYCLES];
    const char *type_names[VALUE_TYPES];
    const char *count_name; /* FMI's name of the number of references in a call */
    const char *token;      /* FMI's name of MODEL_GUID */
} FmiVersion;

/* The version that this FMU is for. */
extern const FmiVersion FMI;

/* Whether initialization has ended. */
static inline bool has_begun(Lifecycle state) {
    return state >= STEP_COMPLETE;
}

/* Whether initialization has ended and the simulation has not. */
static inline bool is_running(Lifecycle state) {
    return state == STEP_COMPLETE || state == EVENT_MODE;
}

/* Refuse the call in any state but `required`. */
static inline bool require(const char *call, Lifecycle state, Lifecycle required, Refusal *refusal) {
    return state == required || refuse_wrong_state(refusal, call, FMI.state_names[state], FMI.state_names[required]);
}

/* Go from one state to the next; refuse the call in any other state. */
static inline bool lifecycle_change(Lifecycle *state, const char *call, Lifecycle from, Lifecycle to,
                                    Refusal *refusal) {
    if (!require(call, *state, from, refusal)) {
        return false;
    }
    *state = to;
    return true;
}
