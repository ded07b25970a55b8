/* Runs instances in as many threads at once, and then one by one: the numbers must be the same.
 *
 *     threads LIBRARY GUID THREADS STEPS
 *
 * Each instance has a law, fidelity, phase and load of its own, and steps of 1 ms; threads hand their
 * state on to a second instance half-way. Fails (1) when a call is refused or a number differs. */
#include <pthread.h>
#include <stdlib.h>

#include "fmu_library.h"
#include "variables.h"

enum { FAILED = 1, COULD_NOT_RUN = 2, MAX_THREADS = 64, OUTPUTS = VARIABLE_COUNT - SETTABLE_COUNT };

typedef struct {
    int number;
    int refused;
    fmi2Real outputs[OUTPUTS];
} Run;

static FmuLibrary fmu;
static const char *guid;
static int steps;

static void *allocate(size_t count, size_t size) {
    return calloc(count, size);
}

static void log_message(fmi2ComponentEnvironment environment, fmi2String instance, fmi2Status status,
                        fmi2String category, fmi2String message, ...) {
    (void)environment;
    fprintf(stderr, "%s [%s, status %d]: %s\n", instance, category, (int)status, message);
}

static fmi2Component start(Run *run) {
    static const fmi2CallbackFunctions callbacks = {log_message, allocate, free, NULL, NULL};
    const fmi2ValueReference choices[] = {VR_FRICTION_LAW, VR_FIDELITY}, inputs[] = {VR_PHASE, VR_LOAD};
    const fmi2Integer chosen[] = {run->number % 2, 2 - run->number / 2 % 3};
    const fmi2Real values[] = {0.4 + 0.1 * run->number, 0.01 * run->number};
    fmi2Component c = fmu.Instantiate("one of several", fmi2CoSimulation, guid, "file:///nowhere",
                                      &callbacks, fmi2False, fmi2True);
    if (!c || fmu.SetInteger(c, choices, 2, chosen) || fmu.SetReal(c, inputs, 2, values)
        || fmu.SetupExperiment(c, fmi2False, 0.0, 0.0, fmi2False, 0.0)
        || fmu.EnterInitializationMode(c) || fmu.ExitInitializationMode(c))
        run->refused = 1;
    return c;
}

static void advance(Run *run, fmi2Component c, int from, int to) {
    for (; from < to && !run->refused; from++)
        run->refused = fmu.DoStep(c, 1e-3 * from, 1e-3, fmi2True) != fmi2OK;
}

static void *go(void *argument) {
    Run *run = argument;
    fmi2ValueReference references[OUTPUTS];
    fmi2FMUstate state = NULL;
    fmi2Component first = start(run), second = start(run);
    unsigned i;
    for (i = 0; i < OUTPUTS; i++) references[i] = SETTABLE_COUNT + i;
    advance(run, first, 0, steps / 2);
    run->refused |= fmu.GetFMUstate(first, &state) || fmu.SetFMUstate(second, state)
                    || fmu.FreeFMUstate(first, &state);
    fmu.FreeInstance(first);
    advance(run, second, steps / 2, steps);
    run->refused |= fmu.GetReal(second, references, OUTPUTS, run->outputs) != fmi2OK;
    fmu.FreeInstance(second);
    return NULL;
}

int main(int count, char **arguments) {
    static Run together[MAX_THREADS], alone[MAX_THREADS];
    pthread_t threads[MAX_THREADS];
    int number, runs;
    if (count != 5 || !load_fmu_library(&fmu, arguments[1])) return COULD_NOT_RUN;
    guid = arguments[2];
    runs = atoi(arguments[3]);
    steps = atoi(arguments[4]);
    if (runs < 1 || runs > MAX_THREADS) return COULD_NOT_RUN;
    for (number = 0; number < runs; number++) {
        together[number].number = alone[number].number = number;
        if (pthread_create(&threads[number], NULL, go, &together[number])) return COULD_NOT_RUN;
    }
    for (number = 0; number < runs; number++) pthread_join(threads[number], NULL);
    for (number = 0; number < runs; number++) {
        go(&alone[number]);
        if (together[number].refused || alone[number].refused
            || memcmp(together[number].outputs, alone[number].outputs, sizeof alone->outputs)) {
            printf("thread %d: refused, or other numbers than alone\n", number);
            return FAILED;
        }
    }
    printf("%d threads, %d steps each: the same numbers as alone\n", runs, steps);
    return 0;
}
