/* An FMU that does nothing, and goes wrong in one place that is chosen when it is compiled. */
#include <stdio.h>
#include <stdlib.h>

#ifndef IN_INSTANTIATE
#define IN_INSTANTIATE
#endif
#ifndef IN_STEP
#define IN_STEP
#endif
#ifndef IN_FREE
#define IN_FREE
#endif
#ifndef VALUE
#define VALUE 0.0
#endif
#define CRASH abort();
#define LOOP for (volatile int turn = 1; turn;) { }
#define LEAVE exit(0);
#define PRINT puts("stepping \x01 <now>"); fflush(stdout);
#define EXPORT __attribute__((visibility("default")))

typedef void *C;
typedef unsigned int R;
typedef int I;

static int instance;

EXPORT const char *fmi2GetTypesPlatform(void) { return "default"; }
EXPORT const char *fmi2GetVersion(void) { return "2.0"; }
EXPORT I fmi2SetDebugLogging(C c, I on, size_t n, const char *const *s) { return 0; }
EXPORT C fmi2Instantiate(const char *n, I t, const char *guid, const char *r, const void *f, I v, I l)
{
    IN_INSTANTIATE
    return &instance;
}
EXPORT void fmi2FreeInstance(C c) { IN_FREE }
EXPORT I fmi2SetupExperiment(C c, I td, double t, double start, I sd, double stop) { return 0; }
EXPORT I fmi2EnterInitializationMode(C c) { return 0; }
EXPORT I fmi2ExitInitializationMode(C c) { return 0; }
EXPORT I fmi2Terminate(C c) { return 0; }
EXPORT I fmi2Reset(C c) { return 0; }
EXPORT I fmi2GetReal(C c, const R *r, size_t n, double *values)
{
    for (size_t i = 0; i < n; i++)
        values[i] = VALUE;
    return 0;
}
EXPORT I fmi2GetInteger(C c, const R *r, size_t n, I *values)
{
    for (size_t i = 0; i < n; i++)
        values[i] = (I)VALUE;
    return 0;
}
EXPORT I fmi2SetReal(C c, const R *r, size_t n, const double *values) { return 0; }
EXPORT I fmi2SetInteger(C c, const R *r, size_t n, const I *values) { return 0; }
EXPORT I fmi2DoStep(C c, double t, double step, I no_rollback)
{
    IN_STEP
    return 0;
}

#include "uncalled_functions.h"
