/* The states of FMI 2.0 co-simulation, and which call needs which. */
#ifndef SLIDER_LIFECYCLE_H
#define SLIDER_LIFECYCLE_H

#include <stdbool.h>

#include "refusal_texts.h"

typedef enum { INSTANTIATED, INITIALIZATION, STEP_COMPLETE, TERMINATED, LIFECYCLES } Lifecycle;

/* FMI's name of a state. */
static inline const char *lifecycle_name(Lifecycle state) {
    static const char *const NAMES[LIFECYCLES] = {"instantiated", "initialization mode",
                                                  "step complete", "terminated"};
    return NAMES[state];
}

/* Refuse the call in any state but `required`. */
static inline bool require(const char *call, Lifecycle state, Lifecycle required,
                           Refusal *refusal) {
    return state == required
           || refuse_wrong_state(refusal, call, lifecycle_name(state), lifecycle_name(required));
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

#endif
