/* An FMU that does nothing, and goes wrong in one place that is chosen when it is compiled. */
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

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
#define FAULT fault();
#define PRINT puts("stepping \x01 <now>"); fflush(stdout);
#define EXPORT __attribute__((visibility("default")))

typedef void *C;
typedef unsigned int R;
typedef int I;

static int instance;
typedef void (*Log)(void *, const char *, I, const char *, const char *, ...);
static Log log_message;

#ifndef _WIN32
static void rest(void)
{
    for (;;)
        pause();
}

/* Does what the environment variable FAULT names, up to a colon. */
static void fault(void)
{
    const char *given = getenv("FAULT");
    char name[32] = "";
    if (!given)
        return;
    strncpy(name, given, strcspn(given, ":") < 31 ? strcspn(given, ":") : 31);
    if (!strcmp(name, "fork") && !fork())
        rest();
    if (!strcmp(name, "fork_session") && !fork()) {
        setsid();
        rest();
    }
    if (!strcmp(name, "fork_twice") && !fork()) {
        setsid();
        if (fork())
            _exit(0);
        setsid();
        rest();
    }
    if (!strcmp(name, "fork_many")) {
        for (int generation = 0; generation < 8; generation++)
            fork();
        rest();
    }
    if (!strcmp(name, "fork_and_exit")) {
        if (!fork()) {
            setsid();
            rest();
        }
        exit(0);
    }
    if (!strcmp(name, "exit"))
        exit(0);
    if (!strcmp(name, "crash"))
        abort();
    if (!strcmp(name, "sleep"))
        rest();
    if (!strcmp(name, "stop"))
        kill(getpid(), SIGSTOP);
    while (!strcmp(name, "spam"))
        puts("\x1b[31m::error::spam spam spam spam spam spam spam spam");
    while (!strcmp(name, "spam_log"))
        log_message(NULL, "harness1", 0, "logAll", "%s", "::error::spam spam spam spam spam");
    while (!strcmp(name, "eat")) {
        volatile char *block = malloc(1 << 24);
        for (size_t i = 0; i < 1 << 24; i += 1024)
            block[i] = 1;
    }
    if (!strcmp(name, "kill_group"))
        kill(0, SIGKILL);
    if (!strcmp(name, "kill_parent"))
        kill(getppid(), SIGKILL);
}
#endif

EXPORT const char *fmi2GetTypesPlatform(void) { return "default"; }
EXPORT const char *fmi2GetVersion(void) { return "2.0"; }
EXPORT I fmi2SetDebugLogging(C c, I on, size_t n, const char *const *s) { return 0; }
EXPORT C fmi2Instantiate(const char *n, I t, const char *guid, const char *r, const void *f, I v, I l)
{
    log_message = *(const Log *)f;
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
