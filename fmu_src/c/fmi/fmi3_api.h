/* The functions of FMI 3.0, and the answers of an instance as their status. */
#pragma once

#include "fmi3Functions.h"
#include "instance.h"

/* As send_answer. */
static inline fmi3Status answer(const Instance *instance, bool done, const Refusal *refusal) {
    return (fmi3Status)send_answer(instance, done, refusal);
}

/* Refuse a call that this FMU does not offer, with the `reason`. */
fmi3Status not_offered(fmi3Instance instance, const char *call, const char *reason);

/* Refuse NULL where the function `call` must write its results. */
bool results_check(const char *call, bool all_given, Refusal *refusal);

/* A host of FMI 3.0. */
Host fmi3_host(fmi3InstanceEnvironment environment, fmi3LogMessageCallback logger);
