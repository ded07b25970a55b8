/* The states of FMI co-simulation, and which call needs which. */
#pragma once

#include <stdbool.h>

#include "../base/refusal_texts.h"
#include "fmi_version.h"

/* Whether initialization has ended and the simulation has not. */
static inline bool is_running(Lifecycle state) {
    return state == STEP_COMPLETE || state == EVENT_MODE;
}

/* Refuse the call in any state but `required`. */
static inline bool require(const char *call, Lifecycle state, Lifecycle required,
                           Refusal *refusal) {
    return state == required
           || refuse_wrong_state(refusal, call, FMI.state_names[state],
                              FMI.state_names[required]);
}

/* Go from one state to the next; refuse the call in any other state. */
static inline bool lifecycle_change(Lifecycle *state, const char *call, Lifecycle from,
                                    Lifecycle to, Refusal *refusal) {
    if (!require(call, *state, from, refusal)) {
        return false;
    }
    *state = to;
    return true;
}
