/* The functions of FMI 3.0, and the answers of an instance as their status. */
#pragma once

#include "fmi3Functions.h"
#include "instance.h"

/* As send_answer. */
static inline fmi3Status answer(const Instance *instance, bool done, const Refusal *refusal) {
    return (fmi3Status)send_answer(instance, done, refusal);
}

/* A host of FMI 3.0. */
Host fmi3_host(fmi3InstanceEnvironment environment, fmi3LogMessageCallback logger);
