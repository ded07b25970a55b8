/* The functions of FMI 2.0, and the answers of an instance as their status. */
#pragma once

#include "fmi2Functions.h"
#include "instance.h"

/* The header of fmpy leaves out the prefix of FMI 2.0 for static linking. */
#ifdef FMI2_FUNCTION_PREFIX
#undef fmi2FullName
#define fmi2Paste(a, b) a##b
#define fmi2PasteB(a, b) fmi2Paste(a, b)
#define fmi2FullName(name) fmi2PasteB(FMI2_FUNCTION_PREFIX, name)
#endif

/* As send_report and send_answer. */
static inline fmi2Status report(const Instance *instance, fmi2Status status, const char *text) {
    return (fmi2Status)send_report(instance, (Status)status, text);
}

static inline fmi2Status answer(const Instance *instance, bool done, const Refusal *refusal) {
    return (fmi2Status)send_answer(instance, done, refusal);
}
