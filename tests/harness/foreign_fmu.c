/* An FMU as another tool might have made it: other value references, no state to get or set, one
   instance in a process, one size of step. It passes every call on to a library in its resources. */
#include <dlfcn.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#define EXPORT __attribute__((visibility("default")))
#define MOST 64
#define ERROR 3

typedef void *C;
typedef unsigned int R;
typedef int I;

static void *library;
static int instances;
static double first_step;

static R original(R reference) { return reference % 7 == 1000 % 7 ? (reference - 1000) / 7 : 0x7FFFFFFF; }

static void *called(const char *name) { return dlsym(library, name); }

EXPORT const char *fmi2GetTypesPlatform(void) { return "default"; }
EXPORT const char *fmi2GetVersion(void) { return "2.0"; }
EXPORT C fmi2Instantiate(const char *n, I t, const char *guid, const char *r, const void *f, I v, I l)
{
    char path[4096];
    C (*instantiate)(const char *, I, const char *, const char *, const void *, I, I);
    if (instances++)
        return NULL;
    snprintf(path, sizeof path, "%s/original.so", strncmp(r, "file://", 7) ? r : r + 7);
    library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (!library)
        return NULL;
    *(void **)&instantiate = called("fmi2Instantiate");
    return instantiate(n, t, guid, r, f, v, l);
}
EXPORT void fmi2FreeInstance(C c)
{
    void (*function)(C);
    *(void **)&function = called("fmi2FreeInstance");
    function(c);
}

#define PASS(name, parameters, arguments) \
    EXPORT I name parameters \
    { \
        I (*function) parameters; \
        *(void **)&function = called(#name); \
        return function arguments; \
    }
PASS(fmi2SetDebugLogging, (C c, I on, size_t n, const char *const *s), (c, on, n, s))
PASS(fmi2SetupExperiment, (C c, I td, double t, double start, I sd, double stop),
     (c, td, t, start, sd, stop))
PASS(fmi2EnterInitializationMode, (C c), (c))
PASS(fmi2ExitInitializationMode, (C c), (c))
PASS(fmi2Terminate, (C c), (c))

EXPORT I fmi2Reset(C c)
{
    I (*function)(C);
    *(void **)&function = called("fmi2Reset");
    first_step = 0.0;
    return function(c);
}

#define PASS_VALUES(name, type) \
    EXPORT I name(C c, const R *references, size_t n, type *values) \
    { \
        I (*function)(C, const R *, size_t, type *); \
        R originals[MOST]; \
        if (n > MOST) \
            return ERROR; \
        for (size_t i = 0; i < n; i++) \
            originals[i] = original(references[i]); \
        *(void **)&function = called(#name); \
        return function(c, originals, n, values); \
    }
PASS_VALUES(fmi2GetReal, double)
PASS_VALUES(fmi2GetInteger, I)
PASS_VALUES(fmi2SetReal, const double)
PASS_VALUES(fmi2SetInteger, const I)

EXPORT I fmi2DoStep(C c, double t, double step, I no_rollback)
{
    I (*function)(C, double, double, I);
    I status;
    if (first_step != 0.0 && fabs(step - first_step) > 1e-5 * first_step)
        return ERROR;
    *(void **)&function = called("fmi2DoStep");
    status = function(c, t, step, no_rollback);
    if (first_step == 0.0 && status < ERROR)
        first_step = step;
    return status;
}

#include "uncalled_functions.h"
