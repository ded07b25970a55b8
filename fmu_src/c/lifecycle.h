/* The states of FMI 2.0 co-simulation and the calls that each allows. */
#ifndef SLIDER_LIFECYCLE_H
#define SLIDER_LIFECYCLE_H

#include <stdbool.h>

#include "refusal.h"

typedef enum { INSTANTIATED, INITIALIZATION, STEP_COMPLETE, TERMINATED, LIFECYCLES } Lifecycle;

/* FMI's name of a state. */
static inline const char *lifecycle_name(Lifecycle state) {
    static const char *const NAMES[LIFECYCLES] = {"instantiated", "initialization mode",
                                                  "step complete", "terminated"};
    return NAMES[state];
}

/* Refuses, naming call, state and the one that allows it, unless `state` does. */
static inline bool require(const char *call, Lifecycle state, Lifecycle allowed, Refusal *refusal) {
    return state == allowed
           || refuse(refusal, "%s refused in state '%s': allowed in '%s'", call,
                     lifecycle_name(state), lifecycle_name(allowed));
}

#endif
